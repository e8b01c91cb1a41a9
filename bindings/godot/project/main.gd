# A head of hair in Godot 3: 20,000 drawn strands follow 300 simulated guides. Drag with the mouse or hold the arrow keys to turn the head, turn the
# wheel to come closer, press R to cut back to the start, Escape to leave. For scripts:
#   --frames=N           moves the head by itself for N frames, prints what a frame costs, and leaves
#   --screenshot=FILE    what is seen then, as a PNG; with --moments=A,B,C what was seen in these frames, side by side
#   --shrink=yes         the picture at half its size, smooth
#   --report=FILE        the costs and checks as JSON
#   --hairs=N --guides=N --threads=N  --msaa=0..4 --wisp=M --view=DEGREES
#   --hide=yes --bare=yes  without hair; the scalp bright green: what a test looks for
extends Spatial

const Head := preload("res://head.gd")
const NECK := Vector3(0.0, 0.22, -0.01) # the head turns about this point, m
const MIDDLE := Vector3(0.0, 0.35, 0.0) # of the skull, m
const KEY := Vector3(0.42, 0.62, 0.67) # where the light is: that of hair.shader
const RATE := 60.0
const WARM := 30 # frames before the first that counts

var options := {}
var hair: Reference = null
var mesh := ArrayMesh.new()
var head := MeshInstance.new()
var camera := Camera.new()
var label := Label.new()
var turn := Vector2.ZERO # of the head: yaw and pitch, rad
var wanted := Vector2.ZERO
var distance := 0.95
var frame := 0
var spent := {"step": [], "evaluate": [], "upload": [], "draw": [], "frame": []}
var pictures := []

func option(name: String, otherwise):
	return options.get(name, otherwise)

func fail(message: String) -> void:
	if message == "":
		return
	printerr("superhelix: ", message)
	set_process(false)
	get_tree().quit(1)

func _ready() -> void:
	for argument in OS.get_cmdline_args():
		var parts: PoolStringArray = argument.lstrip("-").split("=", true, 1)
		if argument.begins_with("--") and parts.size() == 2:
			options[parts[0]] = parts[1]
	var began := OS.get_ticks_usec()
	var arrays = Head.read(option("head", "res://head.obj"), float(option("head-scale", 0.01)))
	if arrays == null:
		fail("cannot read the head, %s" % option("head", "res://head.obj"))
		return
	show_stage(arrays)
	grow(arrays)
	print("grown in %.0f ms" % (0.001 * (OS.get_ticks_usec() - began)))
	if options.has("frames"):
		# Frames are drawn by force_draw, which returns when they are drawn: what it takes can be measured.
		VisualServer.render_loop_enabled = false

# ---- the scene ----------------------------------------------------------------------------------------------------------

func show_stage(arrays: Array) -> void:
	var skin := ArrayMesh.new()
	var colours := PoolColorArray()
	for amount in Head.density(arrays[Mesh.ARRAY_VERTEX]):
		colours.append(Color(0.72, 0.47, 0.36).linear_interpolate(Color(0.1, 0.055, 0.035), 0.92 * amount))
	if options.has("bare"):
		for i in colours.size():
			colours[i] = Color(0.0, 1.0, 0.0) if Head.density(PoolVector3Array([arrays[Mesh.ARRAY_VERTEX][i]]))[0] > 0.99 else Color(0.5, 0.0, 0.0)
	arrays[Mesh.ARRAY_COLOR] = colours
	skin.add_surface_from_arrays(Mesh.PRIMITIVE_TRIANGLES, arrays)
	var material := SpatialMaterial.new()
	material.vertex_color_use_as_albedo = true
	material.roughness = 0.55
	material.flags_unshaded = options.has("bare")
	skin.surface_set_material(0, material)
	head.mesh = skin
	add_child(head)
	var light := DirectionalLight.new()
	light.look_at_from_position(Vector3.ZERO, -KEY, Vector3.UP)
	light.light_color = Color(1.0, 0.95, 0.88)
	add_child(light)
	var surroundings := WorldEnvironment.new()
	surroundings.environment = Environment.new()
	surroundings.environment.background_mode = Environment.BG_COLOR
	surroundings.environment.background_color = Color(0.16, 0.18, 0.21)
	surroundings.environment.ambient_light_color = Color(0.8, 0.85, 1.0)
	surroundings.environment.ambient_light_energy = 0.45
	add_child(surroundings)
	for side in [-1.0, 1.0]:
		add_ball(Vector3(0.0400 * side, 0.318, 0.0675), 0.0180, Color(0.55, 0.52, 0.50))
		add_ball(Vector3(0.0400 * side, 0.319, 0.0755), 0.0115, Color(0.10, 0.12, 0.09))
	distance = float(option("distance", distance))
	camera.fov = 28.0
	camera.near = 0.05
	add_child(camera)
	label.rect_position = Vector2(12, 10)
	label.visible = not options.has("frames")
	add_child(label)
	look()

# The bust has no eyes.
func add_ball(centre: Vector3, radius: float, colour: Color) -> void:
	var ball := MeshInstance.new()
	ball.mesh = SphereMesh.new()
	ball.mesh.radius = radius
	ball.mesh.height = 2.0 * radius
	ball.material_override = SpatialMaterial.new()
	ball.material_override.albedo_color = colour
	ball.material_override.roughness = 0.2
	ball.translation = centre
	head.add_child(ball)

func look() -> void:
	var around := deg2rad(float(option("view", 0.0)))
	var at := Vector3(0.0, 0.305, 0.0)
	camera.look_at_from_position(at + Vector3(sin(around), 0.08, cos(around)) * distance, at, Vector3.UP)

# ---- hair ---------------------------------------------------------------------------------------------------------------

func grow(arrays: Array) -> void:
	var script = load("res://hair.gdns")
	hair = script.new() if script != null else null
	if hair == null:
		fail("the library does not load")
		return
	var how := {}
	for pair in [["guides", "guides"], ["hairs", "hairs"], ["threads", "workers"], ["points", "points"], ["elements", "elements"], ["wisp", "wisp_radius"], ["wave", "wave"], ["length", "length"], ["hold", "hold"]]:
		if options.has(pair[0]):
			how[pair[1]] = float(options[pair[0]])
	var vertices: PoolVector3Array = arrays[Mesh.ARRAY_VERTEX]
	var message: String = hair.grow(vertices, arrays[Mesh.ARRAY_INDEX], Head.density(vertices), how)
	if message != "":
		fail(message)
		return
	# The surface is made once. Afterwards the library writes positions and frames between its texture coordinates, in place.
	mesh.add_surface_from_arrays(Mesh.PRIMITIVE_LINES, hair.surface(), [], 0)
	var format := VisualServer.mesh_surface_get_format(mesh.get_rid(), 0)
	var count := VisualServer.mesh_surface_get_array_len(mesh.get_rid(), 0)
	var indices := VisualServer.mesh_surface_get_array_index_len(mesh.get_rid(), 0)
	var stride := VisualServer.mesh_surface_get_format_stride(format, count, indices)
	var colour := VisualServer.mesh_surface_get_format_offset(format, count, indices, Mesh.ARRAY_COLOR)
	fail(hair.use_vertices(VisualServer.mesh_surface_get_array(mesh.get_rid(), 0), stride, colour))
	var material := ShaderMaterial.new()
	material.shader = load("res://hair.shader")
	mesh.surface_set_material(0, material)
	# Godot measures a surface when it is made, and would not draw this one: say where it can be.
	mesh.custom_aabb = AABB(Vector3(-1, -1, -1), Vector3(2, 2, 2))
	var drawn := MeshInstance.new()
	drawn.mesh = mesh
	drawn.visible = not options.has("hide")
	add_child(drawn)
	draw_hair()

func draw_hair() -> void:
	var began := OS.get_ticks_usec()
	fail(hair.draw())
	var written := OS.get_ticks_usec()
	VisualServer.mesh_surface_update_region(mesh.get_rid(), 0, 0, hair.vertices())
	spent.evaluate.append(written - began)
	spent.upload.append(OS.get_ticks_usec() - written)

func pose(angles: Vector2) -> Transform:
	var turned := Basis(Vector3(angles.y, angles.x, 0.0))
	return Transform(turned, NECK - turned.xform(NECK))

# ---- frames -------------------------------------------------------------------------------------------------------------

func _process(delta: float) -> void:
	if hair == null:
		return
	var now := OS.get_ticks_usec()
	var seconds := 1.0 / RATE
	if options.has("frames"):
		var t := frame / RATE
		wanted = Vector2(0.9 * sin(4.0 * t), 0.12 * sin(5.3 * t)) * smoothstep(0.0, 0.5, t)
		turn = wanted
	else:
		seconds = clamp(delta, 0.002, 0.05)
		wanted.x += 2.5 * seconds * (Input.get_action_strength("ui_right") - Input.get_action_strength("ui_left"))
		wanted.y = clamp(wanted.y + 1.5 * seconds * (Input.get_action_strength("ui_down") - Input.get_action_strength("ui_up")), -0.6, 0.6)
		turn = turn.linear_interpolate(wanted, 1.0 - exp(-12.0 * seconds))
	head.transform = pose(turn)
	mesh.surface_get_material(0).set_shader_param("middle", head.transform.xform(MIDDLE))
	fail(hair.move(head.transform, seconds))
	var began := OS.get_ticks_usec()
	fail(hair.step(seconds, 1))
	spent.step.append(OS.get_ticks_usec() - began)
	draw_hair()
	if options.has("frames"):
		var before := OS.get_ticks_usec()
		VisualServer.force_draw(true, seconds)
		spent.draw.append(OS.get_ticks_usec() - before)
		spent.frame.append(OS.get_ticks_usec() - now)
	elif frame % 15 == 14:
		label.text = "simulation %.1f ms, render hair %.1f ms, upload %.1f ms, %d frames a second" % [median(spent.step), median(spent.evaluate),
			median(spent.upload), Engine.get_frames_per_second()]
		for name in spent:
			spent[name].clear()
	if str(frame) in option("moments", "").split(","):
		pictures.append(picture())
	frame += 1
	if options.has("frames") and frame >= int(options.frames):
		finish()

func _input(event: InputEvent) -> void:
	if event is InputEventMouseMotion and event.button_mask & BUTTON_MASK_LEFT:
		wanted += Vector2(0.008, 0.006) * event.relative
		wanted.y = clamp(wanted.y, -0.6, 0.6)
	elif event is InputEventMouseButton and event.pressed and event.button_index in [BUTTON_WHEEL_UP, BUTTON_WHEEL_DOWN]:
		distance = clamp(distance * (0.93 if event.button_index == BUTTON_WHEEL_UP else 1.07), 0.4, 3.0)
		look()
	elif event is InputEventKey and event.pressed and event.scancode == KEY_R:
		turn = Vector2.ZERO
		wanted = turn
		if hair != null:
			fail(hair.teleport(pose(turn)))
	elif event.is_action_pressed("ui_cancel"):
		get_tree().quit()

# ---- what a script wants ------------------------------------------------------------------------------------------------

static func median(microseconds: Array) -> float:
	var sorted := microseconds.duplicate()
	sorted.sort()
	return 0.001 * sorted[sorted.size() / 2] if sorted.size() > 0 else 0.0

func picture() -> Image:
	var seen := get_viewport().get_texture().get_data()
	seen.flip_y()
	seen.convert(Image.FORMAT_RGB8)
	if options.has("shrink"):
		seen.shrink_x2()
	return seen

static func count_green(seen: Image) -> int:
	var found := 0
	var bytes := seen.get_data()
	for i in range(0, bytes.size(), 3):
		if bytes[i] < 20 and bytes[i + 1] > 220 and bytes[i + 2] < 20:
			found += 1
	return found

func finish() -> void:
	set_process(false)
	var report: Dictionary = hair.state()
	for name in spent:
		var counted: Array = spent[name].slice(min(WARM, spent[name].size() - 1), spent[name].size() - 1)
		report[name + "_ms"] = [stepify(median(counted), 0.01), stepify(0.001 * counted.max(), 0.01)]
		print("%-9s median %6.2f ms, worst %6.2f ms" % [name, report[name + "_ms"][0], report[name + "_ms"][1]])
	if options.has("screenshot"):
		if pictures.empty():
			pictures.append(picture())
		var size: Vector2 = pictures[0].get_size()
		var strip := Image.new()
		strip.create(int(size.x) * pictures.size(), int(size.y), false, pictures[0].get_format())
		for i in pictures.size():
			strip.blit_rect(pictures[i], Rect2(Vector2.ZERO, size), Vector2(size.x * i, 0.0))
		if options.has("bare"):
			report["scalp_pixels"] = count_green(strip)
		if size.x == 0.0 or strip.save_png(options.screenshot) != OK:
			fail("cannot write %s" % options.screenshot)
			return
	if options.has("report"):
		var file := File.new()
		if file.open(options.report, File.WRITE) != OK:
			fail("cannot write %s" % options.report)
			return
		file.store_string(to_json(report))
		file.close()
	get_tree().quit(0)

# The head: its mesh from a Wavefront file, and where hair grows on it.
extends Reference

# The surface of a Wavefront file (v and f lines), in metres, with smooth normals. Null if it cannot be read.
static func read(path: String, scale: float):
	var file := File.new()
	if file.open(path, File.READ) != OK:
		return null
	var vertices := PoolVector3Array()
	var indices := PoolIntArray()
	while not file.eof_reached():
		var words := file.get_line().split(" ", false)
		if words.size() >= 4 and words[0] == "v":
			vertices.append(Vector3(float(words[1]), float(words[2]), float(words[3])) * scale)
		elif words.size() >= 4 and words[0] == "f":
			for i in range(2, words.size() - 1):
				# Counter-clockwise in the file, clockwise in Godot.
				for word in [words[1], words[i + 1], words[i]]:
					indices.append(int(word.split("/")[0]) - 1)
	if indices.size() == 0:
		return null
	var arrays := []
	arrays.resize(Mesh.ARRAY_MAX)
	arrays[Mesh.ARRAY_VERTEX] = vertices
	arrays[Mesh.ARRAY_INDEX] = indices
	arrays[Mesh.ARRAY_NORMAL] = normals(vertices, indices)
	return arrays

static func normals(vertices: PoolVector3Array, indices: PoolIntArray) -> PoolVector3Array:
	var sums := []
	for _i in vertices.size():
		sums.append(Vector3.ZERO)
	for i in range(0, indices.size(), 3):
		var a := vertices[indices[i]]
		var area := (vertices[indices[i + 2]] - a).cross(vertices[indices[i + 1]] - a)
		for k in 3:
			sums[indices[i + k]] += area
	var found := PoolVector3Array()
	for sum in sums:
		found.append(sum.normalized())
	return found

# One number a vertex, 0 to 1: hair grows above a line from the forehead over the ears to the nape, and not on the ears. A game would paint it.
static func density(vertices: PoolVector3Array) -> PoolRealArray:
	var found := PoolRealArray()
	for v in vertices:
		var above: float = v.y - lerp(0.262, 0.388, clamp((v.z + 0.07) / 0.165, 0.0, 1.2))
		# The temples recede.
		above -= 0.3 * max(abs(v.x) - 0.05, 0.0) * clamp((v.z - 0.02) / 0.04, 0.0, 1.0)
		var ear: float = clamp((abs(v.x) - 0.0825) / 0.002, 0.0, 1.0) if v.y < 0.37 else 0.0
		found.append(clamp(above / 0.012, 0.0, 1.0) * (1.0 - ear))
	return found

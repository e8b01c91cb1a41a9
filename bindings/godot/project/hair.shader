// Hair as lines, lit at their vertices along the tangents: diffuse light as Kajiya and Kay (1989) have it, a white highlight shifted towards the root and a
// coloured one shifted towards the tip (Marschner et al. 2003, in the form of Scheuermann 2004). Unshaded for Godot: its own lighting would run once more
// for each light and each fragment, which software OpenGL pays dearly.
shader_type spatial;
render_mode unshaded, cull_disabled;

uniform vec4 root_colour : hint_color = vec4(0.17, 0.085, 0.045, 1.0);
uniform vec4 tip_colour : hint_color = vec4(0.58, 0.34, 0.18, 1.0);
uniform vec3 middle = vec3(0.0, 0.35, 0.0); // of the skull, world, m
// Where the lights are, world, and their colours.
uniform vec3 key = vec3(0.42, 0.62, 0.67);
uniform vec3 key_colour = vec3(1.25, 1.17, 1.08);
uniform vec3 rim = vec3(-0.38, 0.42, -0.82);
uniform vec3 rim_colour = vec3(0.75, 0.85, 1.0);
uniform vec3 sky = vec3(0.30, 0.33, 0.38);

varying vec3 colour;

vec3 light_along(vec3 t, vec3 n, vec3 view, vec3 light, vec3 albedo, float jitter) {
	vec3 across = normalize(n - t * dot(n, t) + vec3(1e-4));
	vec3 h = normalize(light + view);
	float first = dot(normalize(t + (0.10 + jitter) * across), h);
	float second = dot(normalize(t + (-0.18 + jitter) * across), h);
	float sin_light = sqrt(max(1.0 - dot(t, light) * dot(t, light), 0.0));
	// What faces away from the light lies in the shadow of the head and of other hair.
	float facing = smoothstep(-0.35, 0.9, dot(n, light));
	float white = pow(max(1.0 - first * first, 0.0), 48.0);
	float coloured = pow(max(1.0 - second * second, 0.0), 10.0);
	return facing * (albedo * (0.6 * sin_light + 0.7 * coloured) + vec3(0.16, 0.15, 0.14) * white);
}

void vertex() {
	// COLOR is the quaternion of the material frame, as the library writes it: the tangent is x, turned.
	vec4 q = COLOR;
	vec3 t = vec3(1.0 - 2.0 * (q.y * q.y + q.z * q.z), 2.0 * (q.x * q.y + q.w * q.z), 2.0 * (q.x * q.z - q.w * q.y));
	vec3 out_of_head = VERTEX - middle;
	// Below the skull hair hangs as a curtain: its outside is to the side.
	out_of_head.y *= out_of_head.y < 0.0 ? 0.3 : 1.0;
	vec3 n = normalize(out_of_head);
	vec3 view = normalize(CAMERA_MATRIX[3].xyz - VERTEX);
	float shade = UV.x - 0.5;
	vec3 albedo = mix(root_colour.rgb, tip_colour.rgb, clamp(0.10 + 0.75 * UV.y + 0.45 * shade, 0.0, 1.0));
	// Near the roots hair lies under other hair.
	float open = 0.5 + 0.5 * smoothstep(0.0, 0.45, UV.y + 0.2 * shade);
	colour = albedo * sky * (0.7 + 0.3 * n.y);
	colour += key_colour * light_along(t, n, view, key, albedo, 0.16 * shade);
	colour += rim_colour * light_along(t, n, view, rim, albedo, 0.16 * shade);
	colour *= open;
}

void fragment() {
	ALBEDO = colour;
}

// Twin of SplatSetUp.h, setUpWalls.
in float pointHeight;   // above the ground, store units
uniform float heightFactor;
uniform vec3 upwards;   // camera space, unit

/// The rectangle of the wall's corners, in pixels from the centre; nothing where it is not seen.
vec4 setUpWall(vec2 to, float depth, float height)
{
  vec3 n = dot(vec3(to, 1.0), upwards) * upwards - vec3(to, 1.0);
  if (dot(n, n) <= 1.0e-6 * dot(vec3(to, 1.0), vec3(to, 1.0)) || !(height > 0.0))
  {
    return vec4(-1.0, -1.0, 0.0, 0.0);
  }
  splat.normal = normalize(n);
  vec3 right = cross(upwards, splat.normal);
  splat.form = vec4(right, height);
  float ahead = depth - depthRange.x;
  float most = height * upwards.z > ahead ? ahead / upwards.z : height;
  vec2 low = vec2(0.0), high = vec2(0.0);
  for (int corner = 0; corner < 4; ++corner)
  {
    vec3 place = splat.centre.w * (corner % 2 == 0 ? -right : right);
    place -= corner < 2 ? vec3(0.0) : most * upwards;
    float there = max(max(depth + place.z, depthRange.x), 1.0e-30);
    vec2 at = (place.xy - to * place.z) / (POINTFRONT_PARALLEL == 1 ? 1.0 : there);
    low = min(low, at);
    high = max(high, at);
  }
  low = max(low * cameraScale, vec2(-everywhere));
  high = min(high * cameraScale, vec2(everywhere));
  return vec4(0.5 * (high - low), 0.5 * (low + high));
}

// Twin of SplatSamples.h, SplatAt<SplatShape::Wall>.
const float wallFall = 1.0 / 64.0; // units further back for each unit further down
uniform vec2 depthRange;
uniform vec3 upwards;      // camera space, unit
uniform vec3 wallUpper;
uniform vec3 wallLower;
uniform int wallColoured;  // else as the point

/// Adds where on the wall that is: 0 at its top, 1 on the ground.
vec2 sampleWall(vec2 d, out float down)
{
  vec2 ray = d / cameraScale;
  vec2 to = splat.slope.xy;
  float facing = dot(splat.normal, vec3(to, 1.0));
  float turned = dot(splat.normal.xy, ray);
  float depth = splat.centre.z;
  float further =
    POINTFRONT_PARALLEL == 1 ? -turned / facing : -depth * turned / (facing + turned);
  float t = depth + further;
  vec3 u = vec3(POINTFRONT_PARALLEL == 1 ? ray : further * to + t * ray, further);
  down = -dot(u, upwards);
  bool within = abs(dot(u, splat.form.xyz)) <= splat.centre.w && down >= 0.0 &&
    down <= splat.form.w && t >= depthRange.x && t <= depthRange.y;
  down = clamp(down / splat.form.w, 0.0, 1.0);
  return vec2(within ? 1.0 : 2.0, t);
}

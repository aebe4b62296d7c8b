// A point before it is a splat, wherever it comes from: pointOf() gives one for each vertex.
struct Point
{
  vec3 camera;  // camera space, world units
  float radius; // world units, before bounds in pixels
  float grown;  // share of its size
  vec4 colour;
  vec3 normal;  // camera space, any length; 0: none
  vec2 id;      // low and high 24 bits
  bool drawn;   // by this style
};

uniform vec4 clipPlanes[6]; // camera space: n . p + d >= 0 is drawn
uniform int clipCount;
uniform vec2 depthRange;

bool isInView(vec3 camera)
{
  bool inside = camera.z >= depthRange.x && camera.z <= depthRange.y;
  for (int plane = 0; plane < clipCount; ++plane)
  {
    inside = inside && dot(clipPlanes[plane], vec4(camera, 1.0)) >= 0.0;
  }
  return inside;
}

//VTK::System::Dec
// Writes the points that were seen, and only these, to a buffer: as KeptPoint.glsl reads them.
layout(points) in;
layout(points, max_vertices = 1) out;

in Captured
{
  vec3 place;
  float radius;
  vec4 colour;
  vec3 normal;
  vec2 id;
  float seen;
} captured[];

out vec3 capturedPlace;
out float capturedRadius;
out vec4 capturedColour;
out vec3 capturedNormal;
out vec2 capturedId;

void main()
{
  if (captured[0].seen > 0.5)
  {
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    capturedPlace = captured[0].place;
    capturedRadius = captured[0].radius;
    capturedColour = captured[0].colour;
    capturedNormal = captured[0].normal;
    capturedId = captured[0].id;
    EmitVertex();
    EndPrimitive();
  }
}

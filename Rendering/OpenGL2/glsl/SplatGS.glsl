//VTK::System::Dec
// Splats that are larger than the largest point that GL draws, as two triangles each.
//POINTFRONT::Define::Dec
//POINTFRONT::SplatData::Dec
layout(points) in;
layout(triangle_strip, max_vertices = 4) out;

uniform vec2 viewportSize;

in SplatData
{
//POINTFRONT::SplatMembers::Dec
} splatIn[];

out SplatData
{
//POINTFRONT::SplatMembers::Dec
} splat;

void main()
{
  vec4 r = splatIn[0].rectangle;
  if (r.z <= r.x || r.w <= r.y)
  {
    return;
  }
  for (int corner = 0; corner < 4; ++corner)
  {
    splat.centre = splatIn[0].centre;
    splat.form = splatIn[0].form;
    splat.slope = splatIn[0].slope;
    splat.rectangle = r;
    splat.colour = splatIn[0].colour;
    splat.normal = splatIn[0].normal;
    splat.id = splatIn[0].id;
    vec2 place = vec2((corner & 1) == 0 ? r.x : r.z, corner < 2 ? r.y : r.w);
    gl_Position = vec4(2.0 * place / viewportSize - 1.0, 0.0, 1.0);
    EmitVertex();
  }
  EndPrimitive();
}

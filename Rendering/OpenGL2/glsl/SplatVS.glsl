//VTK::System::Dec
// One splat a vertex: where it is on screen, and what its pixels need to know.
// Twin of ProjectionLoops.h and SplatSetUp.h.
//POINTFRONT::Define::Dec
//POINTFRONT::SplatData::Dec

uniform float squareSize; // pixels
uniform vec2 viewportSize;

out SplatData
{
//POINTFRONT::SplatMembers::Dec
} splat;

//POINTFRONT::PointData::Dec
//POINTFRONT::SplatSetUp::Dec
//POINTFRONT::Point::Dec

void main()
{
  gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
  gl_PointSize = 1.0;
  splat.rectangle = vec4(0.0, 0.0, -1.0, -1.0);
  Point point = pointOf();
  splat.colour = point.colour;
  splat.normal = point.normal;
  splat.id = point.id;
  if (!point.drawn || !isInView(point.camera))
  {
    return;
  }
  float grown = point.grown;
#if POINTFRONT_PASS == 2
  splat.colour.a = grown; // share of its weight
  grown = 1.0;
#endif
  float height = 0.0;
#if POINTFRONT_SHAPE == 5
  height = pointHeight * heightFactor;
#endif
  setUp(point.camera, point.radius, grown, height);
  vec4 r = splat.rectangle;
  r = vec4(max(r.xy, vec2(0.0)), min(r.zw, viewportSize));
  splat.rectangle = r;
  vec2 size = r.zw - r.xy;
  if (size.x > 0.0 && size.y > 0.0)
  {
    gl_Position = vec4((r.xy + r.zw) / viewportSize - 1.0, 0.0, 1.0);
    gl_PointSize = max(size.x, size.y);
  }
}

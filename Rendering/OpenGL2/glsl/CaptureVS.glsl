//VTK::System::Dec
// Looks for points that the last picture shows: at the pixel of the centre stands the point's own
// id. At most one a pixel is found (SMOOTH-7).
//POINTFRONT::Define::Dec
uniform vec2 cameraScale;
uniform mat4 cameraToLastClip;
uniform ivec2 lastSize;    // pixels
uniform sampler2D lastIds; // ids of the last picture
uniform int takesAll;      // 1: seen or not

//POINTFRONT::PointData::Dec
//POINTFRONT::Point::Dec

out Captured
{
  vec3 place;
  float radius;
  vec4 colour;
  vec3 normal;
  vec2 id;
  float seen;
} captured;

bool wasSeen(Point point)
{
  vec4 clip = cameraToLastClip * vec4(point.camera, 1.0);
  vec2 share = clip.xy / clip.w * 0.5 + 0.5;
  ivec2 pixel = ivec2(floor(share * vec2(lastSize)));
  bool inside = clip.w > 0.0 && all(greaterThanEqual(pixel, ivec2(0))) &&
    all(lessThan(pixel, lastSize));
  return inside && texelFetch(lastIds, pixel, 0).xy == point.id;
}

void main()
{
  gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
  Point point = pointOf();
  captured.place = point.camera;
  captured.radius = point.radius;
  captured.colour = vec4(point.colour.rgb, 1.0);
  captured.normal = point.normal;
  captured.id = point.id;
  bool taken = point.drawn && point.grown >= 1.0 && (takesAll == 1 || wasSeen(point));
  captured.seen = taken ? 1.0 : 0.0;
}

// Twin of SplatSetUp.h: the same formulas, bounds and constants.
uniform vec2 cameraScale;  // pixels per unit at depth 1; parallel: at any depth
uniform vec2 cameraCentre; // pixels
uniform float leastRadius; // pixels
uniform float mostRadius;
uniform float lowPass;

const float everywhere = 1.0e5;

/// Centre and half width of a conic along one axis, from three entries of its dual.
vec2 conicExtent(float a00, float a02, float a22, float depth)
{
  float root = sqrt(max(a02 * a02 - a00 * a22, 0.0));
  return a22 < -1.0e-3 * depth * depth ? vec2(a02, -root) / a22 : vec2(0.0, everywhere);
}

/// Half edges of an affine ellipse; fills form and slope (EWA-5).
vec2 setUpEllipse(vec2 to, float reach, float pixels)
{
  vec3 n = splat.normal;
  vec2 width = 1.0 / cameraScale;
  float facing = dot(n, vec3(to, 1.0));
  float side = facing < 0.0 ? -1.0 : 1.0;
  float least = 0.05 * sqrt(dot(n, n) * (1.0 + dot(to, to)));
  facing = max(facing * side, least);
  vec2 pixel = reach * width;
  vec2 g = n.xy * (-side / facing) * pixel;
  vec3 a = vec3(pixel.x + to.x * g.x, to.y * g.x, g.x);
  vec3 b = vec3(to.x * g.y, pixel.y + to.y * g.y, g.y);
  float xx = dot(a, a), xy = dot(a, b), yy = dot(b, b);
  float area = splat.centre.w * splat.centre.w / (xx * yy - xy * xy);
  float varianceX = yy * area + lowPass * lowPass;
  float covariance = -xy * area;
  float varianceY = xx * area + lowPass * lowPass;
  float back = 1.0 / (varianceX * varianceY - covariance * covariance);
  splat.form = vec4(varianceY * back, -2.0 * covariance * back, varianceX * back, 0.0);
  splat.slope = vec4(g, to);
  float size = pixels * width.y;
  float bent = POINTFRONT_PARALLEL == 1 ? 1.0 : 1.0 + 5.27 * min(size * size, 0.81);
  vec2 most = size * cameraScale * (1.0 + 0.5 * to * to) * bent + 1.0;
  return max(min(sqrt(vec2(varianceX, varianceY)), most), vec2(0.5));
}

/// Half edges and middle of what rays through a disc cover, in pixels from the centre.
vec4 setUpExact(vec2 to, float depth)
{
  vec3 n = normalize(splat.normal);
  splat.normal = n;
  float square = splat.centre.w * splat.centre.w;
  splat.form = vec4(n.xy, dot(n, vec3(to, 1.0)), 1.0 / square);
  vec2 tilt = n.xy - to * n.z;
  float a22 = square * (1.0 - n.z * n.z) - depth * depth;
  vec2 a00 = square * (1.0 + to * to - tilt * tilt);
  vec2 a02 = square * (-to - tilt * n.z);
  vec2 x = conicExtent(a00.x, a02.x, a22, depth);
  vec2 y = conicExtent(a00.y, a02.y, a22, depth);
  vec2 flatHalf = splat.centre.w * sqrt(max(1.0 - n.xy * n.xy, vec2(0.0)));
  vec2 halfEdges = (POINTFRONT_PARALLEL == 1 ? flatHalf : vec2(x.y, y.y)) * cameraScale;
  vec2 moved = POINTFRONT_PARALLEL == 1 ? vec2(0.0) : vec2(x.x, y.x) * cameraScale;
  return vec4(max(halfEdges, max(lowPass, 0.5) + abs(moved)), moved);
}

vec4 setUpSphere(vec2 to, float depth)
{
  float square = splat.centre.w * splat.centre.w;
  splat.form = vec4(1.0 / square, 0.0, 0.0, 0.0);
  float a22 = square - depth * depth;
  vec2 a00 = square * (1.0 + to * to);
  vec2 a02 = -square * to;
  vec2 x = conicExtent(a00.x, a02.x, a22, depth);
  vec2 y = conicExtent(a00.y, a02.y, a22, depth);
  if (POINTFRONT_PARALLEL == 1)
  {
    return vec4(splat.centre.w * cameraScale, 0.0, 0.0);
  }
  bool outside = depth * depth * (1.0 + dot(to, to)) > square;
  return outside ? vec4(x.y, y.y, x.x, y.x) * cameraScale.xyxy : vec4(-1.0, -1.0, 0.0, 0.0);
}

//POINTFRONT::WallSetUp::Dec

/// Whether the splat's sphere meets the pyramid through the viewport: rectangles of what reaches
/// behind the eye say nothing.
bool meetsView(vec3 camera)
{
  vec2 high = (viewportSize - cameraCentre) / cameraScale;
  vec2 low = cameraCentre / cameraScale;
  float reach = splat.centre.w * 1.01 + camera.z / cameraScale.x;
  vec2 beyond = camera.xy - high * camera.z, before = -low * camera.z - camera.xy;
  return all(lessThanEqual(beyond, reach * sqrt(1.0 + high * high))) &&
    all(lessThanEqual(before, reach * sqrt(1.0 + low * low)));
}

/// Fills all that the pixels need, and the rectangle of pixels that it may cover.
/// `grown`: of its radius, once that is at least what a pixel needs.
void setUp(vec3 camera, float radius, float grown, float height)
{
  float reach = POINTFRONT_PARALLEL == 1 ? 1.0 : camera.z;
  vec2 to = POINTFRONT_PARALLEL == 1 ? vec2(0.0) : camera.xy / camera.z;
  vec2 screen = cameraCentre + camera.xy / reach * cameraScale;
  float pixels = clamp(radius * cameraScale.y / reach, leastRadius, mostRadius);
  pixels = max(pixels * grown, 0.05);
  splat.centre = vec4(screen, camera.z, pixels * reach / cameraScale.y);
  splat.form = vec4(0.0);
  splat.slope = vec4(to, 0.0, 0.0);
#if POINTFRONT_SHAPE == 0
  float edge = floor(squareSize * grown + 0.5); // twin of grownSquare()
  vec2 corner = floor(screen - 0.5 * (edge - 1.0));
  splat.rectangle = vec4(corner, corner + edge);
#else
  vec4 extent = vec4(pixels, pixels, 0.0, 0.0);
#if POINTFRONT_SHAPE == 1
  splat.form.x = 1.0 / (pixels * pixels);
#else
  float square = dot(splat.normal, splat.normal); // a wall has its own instead
  splat.normal = square > 1e-12 && square < 1e12 ? splat.normal : vec3(to, 1.0);
#endif
#if POINTFRONT_SHAPE == 2
  extent.xy = setUpEllipse(to, reach, pixels);
#elif POINTFRONT_SHAPE == 3
  extent = setUpExact(to, camera.z);
#elif POINTFRONT_SHAPE == 4
  extent = setUpSphere(to, camera.z);
#elif POINTFRONT_SHAPE == 5
  extent = setUpWall(to, camera.z, height);
#endif
  bool bounded = POINTFRONT_PARALLEL == 1 || POINTFRONT_SHAPE == 5;
  if (extent.x < 0.0 || (!bounded && !meetsView(camera)))
  {
    return;
  }
  vec2 middle = screen + extent.zw;
  splat.rectangle =
    vec4(ceil(middle - extent.xy - 0.5), floor(middle + extent.xy - 0.5) + 1.0);
#endif
}

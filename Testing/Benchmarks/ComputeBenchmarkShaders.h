#pragma once

#include <string>

/// Shaders of compute.cxx.
namespace compute_benchmark
{

const std::string header = "#version 430\n";

/// Where a point lies in the picture.
const std::string view = R"(
uniform mat4 toClip;
uniform vec2 pictureSize;
uniform float metres; // radius
uniform bool shifted; // away from the eye by a radius
float pixelRadius(vec4 clip)
{
  float scale = length(vec3(toClip[0][1], toClip[1][1], toClip[2][1]));
  return clamp(0.5 * metres * scale * pictureSize.y / clip.w, 0.5, 8.0);
}
/// Depth of what lies a radius farther away: what is no farther than that is blended.
float shiftedDepth(vec4 clip)
{
  vec3 ahead = vec3(toClip[0][3], toClip[1][3], toClip[2][3]);
  vec4 moved = clip + toClip * vec4(metres * normalize(ahead), 0.0);
  return moved.z / moved.w;
}
)";

const std::string pointVertex = R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec4 colour;
flat out vec4 pointColour;
void main()
{
  gl_Position = toClip * vec4(position, 1.0);
  gl_PointSize = 1.0;
  pointColour = colour;
}
)";

const std::string pointFragment = R"(
flat in vec4 pointColour;
out vec4 seen;
void main()
{
  seen = pointColour;
}
)";

const std::string discVertex = R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec4 colour;
flat out vec4 pointColour;
void main()
{
  vec4 clip = toClip * vec4(position, 1.0);
  gl_PointSize = 2.0 * pixelRadius(clip);
  if (shifted)
  {
    clip.z = shiftedDepth(clip) * clip.w;
  }
  gl_Position = clip;
  pointColour = colour;
}
)";

const std::string discFragment = R"(
flat in vec4 pointColour;
out vec4 seen;
void main()
{
  vec2 at = 2.0 * gl_PointCoord - 1.0;
  float square = dot(at, at);
  if (square > 1.0)
  {
    discard;
  }
  float weight = exp(-2.0 * square);
  seen = vec4(weight * pointColour.rgb, weight);
}
)";

const std::string fullScreen = R"(
void main()
{
  vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  gl_Position = vec4(corner, 0.0, 1.0);
}
)";

const std::string meanFragment = R"(
uniform sampler2D sums;
out vec4 seen;
void main()
{
  vec4 sum = texelFetch(sums, ivec2(gl_FragCoord.xy), 0);
  if (sum.a <= 0.0)
  {
    discard;
  }
  seen = vec4(sum.rgb / sum.a, 1.0);
}
)";

/// Buffers that compute shaders and the pass over the picture share.
const std::string buffers = R"(
layout(std430, binding = 0) readonly buffer Points { uvec4 points[]; };
layout(std430, binding = 1) buffer Nearest { uint nearest[]; };
layout(std430, binding = 2) buffer Sums { uint sums[]; };
uniform uint count;
)";

const std::string pixelsOfAPoint = R"(
layout(local_size_x = 256) in;
void inPixel(uint pixel, float depth, vec4 colour, float weight);
void main()
{
  uint id = gl_GlobalInvocationID.x;
  if (id >= count)
  {
    return;
  }
  uvec4 point = points[id];
  vec4 clip = toClip * vec4(uintBitsToFloat(point.xyz), 1.0);
  if (clip.w <= 0.0 || abs(clip.z) > clip.w)
  {
    return;
  }
  vec4 colour = unpackUnorm4x8(point.w);
  vec2 at = (0.5 * clip.xy / clip.w + 0.5) * pictureSize;
  ivec2 size = ivec2(pictureSize);
  if (metres == 0.0)
  {
    ivec2 p = ivec2(floor(at));
    if (all(greaterThanEqual(p, ivec2(0))) && all(lessThan(p, size)))
    {
      inPixel(uint(p.y * size.x + p.x), 0.5 * clip.z / clip.w + 0.5, colour, 1.0);
    }
    return;
  }
  float radius = pixelRadius(clip);
  float own = 0.5 * clip.z / clip.w + 0.5;
  float behind = 0.5 * shiftedDepth(clip) + 0.5;
  ivec2 low = max(ivec2(ceil(at - radius - 0.5)), ivec2(0));
  ivec2 high = min(ivec2(floor(at + radius - 0.5)), size - 1);
  for (int y = low.y; y <= high.y; ++y)
  {
    for (int x = low.x; x <= high.x; ++x)
    {
      vec2 from = (vec2(x, y) + 0.5 - at) / radius;
      float square = dot(from, from);
      if (square <= 1.0)
      {
        inPixel(uint(y * size.x + x), NEAREST_PASS ? behind : own, colour, exp(-2.0 * square));
      }
    }
  }
}
)";

const std::string nearestCompute = "#define NEAREST_PASS true\n" + pixelsOfAPoint + R"(
void inPixel(uint pixel, float depth, vec4 colour, float weight)
{
  uint bits = floatBitsToUint(depth);
  if (bits < nearest[pixel])
  {
    atomicMin(nearest[pixel], bits);
  }
}
)";

const std::string coloursCompute = "#define NEAREST_PASS false\n" + pixelsOfAPoint + R"(
void inPixel(uint pixel, float depth, vec4 colour, float weight)
{
  uint bits = floatBitsToUint(depth);
  if (bits > nearest[pixel])
  {
    return;
  }
  if (metres == 0.0)
  {
    sums[pixel] = packUnorm4x8(colour);
    return;
  }
  uvec4 part = uvec4(4096.0 * weight * vec4(colour.rgb, 1.0) + 0.5);
  for (uint k = 0u; k < 4u; ++k)
  {
    atomicAdd(sums[4u * pixel + k], part[k]);
  }
}
)";

const std::string copyFragment = R"(
uniform vec2 pictureSize;
uniform float metres;
out vec4 seen;
void main()
{
  uint pixel = uint(gl_FragCoord.y) * uint(pictureSize.x) + uint(gl_FragCoord.x);
  if (nearest[pixel] == 0xffffffffu)
  {
    discard;
  }
  gl_FragDepth = uintBitsToFloat(nearest[pixel]);
  if (metres == 0.0)
  {
    seen = unpackUnorm4x8(sums[pixel]);
    return;
  }
  uvec4 sum = uvec4(sums[4u * pixel], sums[4u * pixel + 1u], sums[4u * pixel + 2u],
    sums[4u * pixel + 3u]);
  if (sum.w == 0u)
  {
    discard;
  }
  seen = vec4(vec3(sum.xyz) / float(sum.w), 1.0);
}
)";

} // namespace compute_benchmark

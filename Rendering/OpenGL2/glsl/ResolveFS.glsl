//VTK::System::Dec
// From who is seen in each pixel, and the sums of what is blended there, to a picture: colour, and
// depth from the eye's plane. Twin of WinnerResolve.cxx and Shading.cxx.
//POINTFRONT::Define::Dec
//VTK::Output::Dec

uniform sampler2D seenColours; // alpha: 255 or 127 less the highlight, above 127 for sums
uniform sampler2D seenDepths;  // r: what decided, g: of the splat
#if POINTFRONT_BLENDED
uniform sampler2D colourSums;
#endif
#if POINTFRONT_LIT
uniform sampler2D seenNormals;
uniform vec2 ambientDiffuse;
uniform int lightCount;
uniform vec4 lightPlaces[48];     // a = 0: towards the light, unit; 1: where it is in view space
uniform vec4 lightColours[48];    // a: exponent of the cone
uniform vec4 lightAims[48];       // middle of the cone, unit; a: cosine of its angle, -2: none
uniform vec3 lightAttenuations[48];
uniform mat4 viewToClip;
uniform vec2 viewportSize;

/// Where the pixel's centre is at a depth: the inverse of any frustum.
vec3 placeAt(vec2 windowPx, float depth)
{
  mat4 m = viewToClip;
  vec2 clip = (2.0 * windowPx / viewportSize - 1.0) * (m[3][3] - m[2][3] * depth);
  vec2 view = clip + vec2(m[2][0], m[2][1]) * depth - vec2(m[3][0], m[3][1]);
  return vec3(view / vec2(m[0][0], m[1][1]), -depth);
}

float brightness(int i, float depth, vec3 normal)
{
  if (lightPlaces[i].a == 0.0)
  {
    return max(dot(normal, lightPlaces[i].xyz), 0.0);
  }
  vec3 from = placeAt(gl_FragCoord.xy, depth) - lightPlaces[i].xyz;
  float distance = max(length(from), 1.2e-38);
  vec3 ray = from / distance;
  vec3 fall = lightAttenuations[i];
  float share = max(-dot(normal, ray), 0.0) /
    (fall.x + fall.y * distance + fall.z * distance * distance);
  float cosine = dot(ray, lightAims[i].xyz);
  float cone = cosine >= lightAims[i].a ? pow(max(cosine, 0.0), lightColours[i].a) : 0.0;
  return lightAims[i].a == -2.0 ? share : share * cone;
}
#endif
uniform float depthShift;       // parallel: of the near plane
uniform bool composited;        // with other processes' pictures, by what decided
#if POINTFRONT_EYE_DOME
uniform float eyeDomeStrength;  // with its gain
uniform int eyeDomeReach;       // pixels
uniform float octaveShift;      // parallel: see Shading.cxx
uniform ivec2 pictureSize;

float octaveOf(float depth)
{
  return log2(max(depth + octaveShift, 1.0e-30));
}

float octaveAt(ivec2 at, float own)
{
  if (any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, pictureSize)))
  {
    return own;
  }
  return texelFetch(seenColours, at, 0).a > 0.0
    ? octaveOf(texelFetch(seenDepths, at, 0).g + depthShift) : own;
}

float eyeDomeShade(ivec2 at, float depth)
{
  float own = octaveOf(depth);
  int r = eyeDomeReach;
  ivec2 pairs[4] = ivec2[4](ivec2(r, 0), ivec2(0, r), ivec2(r, r), ivec2(r, -r));
  float response = 0.0;
  for (int i = 0; i < 4; ++i)
  {
    float between = octaveAt(at + pairs[i], own) + octaveAt(at - pairs[i], own);
    response += max(0.0, own - 0.5 * between);
  }
  return exp(-eyeDomeStrength * 0.25 * response);
}
#endif

/// To bytes and back, as each step of the software back end.
vec3 inBytes(vec3 colour)
{
  return floor(clamp(colour * 255.0 + 0.5, 0.0, 255.0)) / 255.0;
}

void main()
{
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec4 seen = texelFetch(seenColours, at, 0);
  if (seen.a == 0.0)
  {
    gl_FragData[0] = vec4(0.0);
    gl_FragData[1] = vec4(3.4e38, 0.0, 0.0, 0.0);
    return;
  }
  vec3 colour = seen.rgb;
#if POINTFRONT_BLENDED
  vec4 sums = texelFetch(colourSums, at, 0);
  if (seen.a > 0.5 && sums.a > 0.0)
  {
    colour = floor((sums.rgb + floor(0.5 * sums.a)) / sums.a) / 255.0;
  }
#endif
  float depth = texelFetch(seenDepths, at, 0).g + depthShift;
#if POINTFRONT_LIT
  vec3 n = texelFetch(seenNormals, at, 0).xyz;
  if (n != vec3(0.0))
  {
    vec3 sum = vec3(ambientDiffuse.x);
    for (int i = 0; i < lightCount; ++i)
    {
      sum += lightColours[i].rgb * (ambientDiffuse.y * brightness(i, depth, n));
    }
    colour = inBytes(colour * sum);
  }
#endif
#if POINTFRONT_EYE_DOME
  colour = inBytes(colour * eyeDomeShade(at, depth));
#endif
  gl_FragData[0] = vec4(colour, 1.0);
  float decided = texelFetch(seenDepths, at, 0).r + depthShift;
  float mark = floor(seen.a * 255.0 + 0.5);
  mark = (mark > 127.0 ? 255.0 : 127.0) - mark;
  gl_FragData[1] = vec4(composited ? decided : depth, mark, 0.0, 0.0);
}

//VTK::System::Dec
// From who is seen in each pixel, and the sums of what is blended there, to a picture: colour, and
// depth from the eye's plane. Twin of WinnerResolve.cxx and Shading.cxx.
//POINTFRONT::Define::Dec
//VTK::Output::Dec

uniform sampler2D seenColours; // alpha: 255 or 127 less the highlight, above 127 for sums
uniform sampler2D seenDepths;  // r: what decided, g: of the splat; b: look, where there are several
#if POINTFRONT_BLENDED
uniform sampler2D colourSums;
#endif
//POINTFRONT::Lights::Dec
uniform float depthShift;       // parallel: of the near plane
uniform bool composited;        // with pictures of others, by what decided
#if POINTFRONT_EYE_DOME
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

float eyeDomeShade(ivec2 at, float depth, vec4 look)
{
  float own = octaveOf(depth);
  int r = int(look.a);
  ivec2 pairs[4] = ivec2[4](ivec2(r, 0), ivec2(0, r), ivec2(r, r), ivec2(r, -r));
  float response = 0.0;
  for (int i = 0; i < 4; ++i)
  {
    float between = octaveAt(at + pairs[i], own) + octaveAt(at - pairs[i], own);
    response += max(0.0, own - 0.5 * between);
  }
  return exp(-look.b * 0.25 * response);
}
#endif

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
  vec3 depths = texelFetch(seenDepths, at, 0).rgb;
  float depth = depths.g + depthShift;
  vec4 look = lookOf(depths.b);
#if POINTFRONT_LIT
  colour = litColour(colour, at, depth, look);
#endif
#if POINTFRONT_EYE_DOME
  if (look.b > 0.0)
  {
    colour = inBytes(colour * eyeDomeShade(at, depth, look));
  }
#endif
  gl_FragData[0] = vec4(colour, 1.0);
  float decided = depths.r + depthShift;
  float mark = floor(seen.a * 255.0 + 0.5);
  mark = (mark > 127.0 ? 255.0 : 127.0) - mark;
  gl_FragData[1] = vec4(composited ? decided : depth, mark, 0.0, 0.0);
}

//VTK::System::Dec
// Fills holes by a pyramid of means, down and up again. Twin of HoleFiller.cxx.
//POINTFRONT::Define::Dec
//VTK::Output::Dec

const float nothing = 3.4e38;
const float nothingThere = 3.0e38;

uniform sampler2D fineColours; // POINTFRONT_STEP 0: of who is seen
uniform sampler2D fineDepths;  // r: what decided, g: of the splat; b: look
#if POINTFRONT_BLENDED
uniform sampler2D colourSums;
#endif
#if POINTFRONT_STEP == 2
uniform sampler2D coarseColours;
uniform sampler2D coarseDepths;
#endif
uniform vec2 agreement;        // how far two depths may differ: by a unit of depth, and always
uniform float levelFactor;     // pixels of the picture in one of the level, along an axis
#if POINTFRONT_LIT
uniform float depthShift;      // parallel: of the near plane
#endif
//POINTFRONT::Lights::Dec

float agreeing(float depth, float factor)
{
  return depth + (agreement.x * abs(depth) + agreement.y) * factor;
}

ivec3 bytesOf(vec4 colour)
{
  return ivec3(floor(colour.rgb * 255.0 + 0.5));
}

vec4 meanOf(ivec3 sum, int parts, float alpha)
{
  return vec4(vec3((sum + parts / 2) / parts) / 255.0, alpha);
}

#if POINTFRONT_STEP == 0
// The levels begin with: colours of who is seen, sums divided, in the light of the frame, for
// a filled pixel has no normal of its own; depths of nothing are far.
void main()
{
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec4 seen = texelFetch(fineColours, at, 0);
#if POINTFRONT_BLENDED
  vec4 sums = texelFetch(colourSums, at, 0);
  if (seen.a > 0.5 && sums.a > 0.0)
  {
    seen.rgb = floor((sums.rgb + floor(0.5 * sums.a)) / sums.a) / 255.0;
  }
#endif
  vec3 depths = texelFetch(fineDepths, at, 0).rgb;
#if POINTFRONT_LIT
  vec4 look = lookOf(depths.b);
  seen.rgb = seen.a > 0.0 ? litColour(seen.rgb, at, depths.g + depthShift, look) : seen.rgb;
#endif
  gl_FragData[0] = seen;
  gl_FragData[1] = vec4(seen.a > 0.0 ? depths : vec3(nothing, nothing, 0.0), 0.0);
}

#elif POINTFRONT_STEP == 1
// One pixel of four.
void main()
{
  ivec2 at = ivec2(gl_FragCoord.xy);
  ivec2 last = textureSize(fineDepths, 0) - 1;
  float depths[4];
  float least = nothing;
  for (int k = 0; k < 4; ++k)
  {
    ivec2 place = 2 * at + ivec2(k & 1, k >> 1);
    depths[k] = any(greaterThan(place, last)) ? nothing : texelFetch(fineDepths, place, 0).g;
    least = min(least, depths[k]);
  }
  gl_FragData[0] = vec4(0.0);
  gl_FragData[1] = vec4(least, least, 0.0, 0.0);
  if (!(least < nothingThere))
  {
    return;
  }
  float most = agreeing(least, levelFactor);
  ivec3 sum = ivec3(0);
  int parts = 0;
  float alpha = 0.0; // with the highlight of the first that agrees
  float look = 0.0; // look of the same pixel
  for (int k = 0; k < 4; ++k)
  {
    if (depths[k] <= most)
    {
      ivec2 place = 2 * at + ivec2(k & 1, k >> 1);
      vec4 colour = texelFetch(fineColours, place, 0);
      sum += bytesOf(colour);
      alpha = parts == 0 ? colour.a : alpha;
      look = parts == 0 ? texelFetch(fineDepths, place, 0).b : look;
      ++parts;
    }
  }
  gl_FragData[0] = meanOf(sum, parts, alpha);
  gl_FragData[1] = vec4(least, least, look, 0.0);
}

#else
// A pixel of the finer level from four of the coarser, if it has nothing or what lies behind them.
const int leastParts = 10;

void main()
{
  ivec2 at = ivec2(gl_FragCoord.xy);
  ivec2 last = textureSize(coarseDepths, 0) - 1;
  ivec2 near = min(at / 2, last);
  ivec2 next = clamp(near + 2 * (at % 2) - 1, ivec2(0), last);
  ivec2 corners[4] = ivec2[4](near, ivec2(next.x, near.y), ivec2(near.x, next.y), next);
  int weights[4] = int[4](9, 3, 3, 1);
  float depths[4];
  float least = nothing;
  for (int k = 0; k < 4; ++k)
  {
    depths[k] = texelFetch(coarseDepths, corners[k], 0).g;
    least = min(least, depths[k]);
  }
  vec4 colour = texelFetch(fineColours, at, 0);
  vec3 depth = texelFetch(fineDepths, at, 0).rgb;
  float most = agreeing(least, 4.0 * levelFactor);
  if (least < nothingThere && depth.g > most)
  {
    ivec3 sum = ivec3(0);
    int parts = 0;
    for (int k = 0; k < 4; ++k)
    {
      if (depths[k] <= most)
      {
        sum += weights[k] * bytesOf(texelFetch(coarseColours, corners[k], 0));
        parts += weights[k];
      }
    }
    if (parts >= leastParts)
    {
      // With so many parts the nearest corner is one that agrees: the pixel has its marks.
      colour = meanOf(sum, parts, texelFetch(coarseColours, near, 0).a);
      // The deciding depth stays where something is: it is compared with other processes' pictures.
      float look = texelFetch(coarseDepths, near, 0).b;
      depth = vec3(depth.r < nothingThere ? depth.r : least, least, look);
    }
  }
  gl_FragData[0] = colour;
  gl_FragData[1] = vec4(depth, 0.0);
}
#endif

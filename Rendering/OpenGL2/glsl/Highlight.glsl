vec4 mixedWith(vec4 own, vec3 colour, float share)
{
  float most = own.a == 0.0 ? 1.0 : share; // over an empty pixel the colour counts alone
  return inBytes(vec4(mix(own.rgb, colour, most), own.a + (1.0 - own.a) * share));
}

#if POINTFRONT_STEP == 2
// All tints at once.
uniform vec4 tints[POINTFRONT_COUNT]; // colour, share

void main()
{
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec4 colour = texelFetch(baseColours, at, 0);
  vec2 own = texelFetch(baseDepths, at, 0).rg;
  int number = int(own.g + 0.5) - 1;
  if (number >= 0)
  {
    colour = mixedWith(colour, tints[number].rgb, tints[number].a);
  }
  gl_FragData[0] = colour;
  gl_FragData[1] = vec4(own, 0.0, 0.0);
#if POINTFRONT_IDS
  gl_FragData[2] = texelFetch(baseIds, at, 0);
#endif
}

#else
// The rim of one of them, rows first: so its cost grows with its width and not with the square.
// Pictures of ids have none: a pixel of it is no point.
uniform int mark;
uniform int reach; // pixels that the rim is wide at most

const float noneInRow = 1.0e6;

#if POINTFRONT_STEP == 3
// Pixels in the row to the nearest that is marked, the left one of two.
bool marked(ivec2 at, int width)
{
  return at.x >= 0 && at.x < width && int(texelFetch(baseDepths, at, 0).g + 0.5) == mark;
}

void main()
{
  ivec2 at = ivec2(gl_FragCoord.xy);
  int width = textureSize(baseDepths, 0).x;
  float across = noneInRow;
  for (int x = 0; x <= reach && across == noneInRow; ++x)
  {
    across = marked(at - ivec2(x, 0), width) ? float(-x)
      : marked(at + ivec2(x, 0), width)      ? float(x)
                                             : noneInRow;
  }
  gl_FragData[0] = vec4(0.0);
  gl_FragData[1] = vec4(across, 0.0, 0.0, 0.0);
}

#else
uniform sampler2D acrossMarks;
uniform vec4 rim; // colour, width in pixels

void main()
{
  ivec2 at = ivec2(gl_FragCoord.xy);
  int last = textureSize(baseDepths, 0).y - 1;
  vec4 colour = texelFetch(baseColours, at, 0);
  vec2 own = texelFetch(baseDepths, at, 0).rg;
  int least = 1 << 20;
  ivec2 from = at;
  for (int y = max(-reach, -at.y); y <= min(reach, last - at.y); ++y)
  {
    float across = texelFetch(acrossMarks, at + ivec2(0, y), 0).r;
    int x = int(across);
    if (across != noneInRow && x * x + y * y < least)
    {
      least = x * x + y * y;
      from = at + ivec2(x, y);
    }
  }
  float share = clamp(rim.a + 1.0 - sqrt(float(least)), 0.0, 1.0);
  float depth = texelFetch(baseDepths, from, 0).r;
  if (int(own.g + 0.5) != mark && share > 0.0 && depth < own.r)
  {
    colour = mixedWith(colour, rim.rgb, share);
    own.r = own.r < nothingThere ? own.r : depth;
  }
  gl_FragData[0] = colour;
  gl_FragData[1] = vec4(own, 0.0, 0.0);
}
#endif
#endif

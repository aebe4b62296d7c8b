vec4 mixedWith(vec4 own, vec3 colour, float share)
{
  float most = own.a == 0.0 ? 1.0 : share; // of what shows nothing the colour counts alone
  return inBytes(vec4(mix(own.rgb, colour, most), own.a + (1.0 - own.a) * share));
}

void main()
{
  ivec2 at = ivec2(gl_FragCoord.xy);
  ivec2 last = textureSize(baseDepths, 0) - 1;
  vec4 colour = texelFetch(baseColours, at, 0);
  vec2 own = texelFetch(baseDepths, at, 0).rg;
  int mark = int(own.g + 0.5);
  if (mark > 0)
  {
    colour = mixedWith(colour, highlights[mark - 1].rgb, tints[mark - 1]);
  }
  int least[POINTFRONT_COUNT];
  float from[POINTFRONT_COUNT];
  for (int i = 0; i < POINTFRONT_COUNT; ++i)
  {
    least[i] = 1 << 20;
  }
  for (int y = -reach; y <= reach; ++y)
  {
    for (int x = -reach; x <= reach; ++x)
    {
      ivec2 there = at + ivec2(x, y);
      if (any(lessThan(there, ivec2(0))) || any(greaterThan(there, last)))
      {
        continue;
      }
      vec2 other = texelFetch(baseDepths, there, 0).rg;
      int number = int(other.g + 0.5) - 1;
      if (number >= 0 && x * x + y * y < least[number])
      {
        least[number] = x * x + y * y;
        from[number] = other.r;
      }
    }
  }
  float depth = own.r;
  for (int i = 0; i < POINTFRONT_COUNT; ++i)
  {
    float halo = highlights[i].a;
    float share = clamp(halo + 1.0 - sqrt(float(least[i])), 0.0, 1.0);
    bool within = least[i] <= int(ceil(halo)) * int(ceil(halo)) * 2;
    if (halo > 0.0 && mark != i + 1 && within && share > 0.0 && from[i] < depth)
    {
      colour = mixedWith(colour, highlights[i].rgb, share);
      depth = depth < nothingThere ? depth : from[i];
    }
  }
  gl_FragData[0] = colour;
  gl_FragData[1] = vec4(depth, own.g, 0.0, 0.0);
#if POINTFRONT_IDS
  gl_FragData[2] = texelFetch(baseIds, at, 0);
#endif
}

// A splat that follows others: it is compared with what was seen before it was drawn, because the
// depth buffer would keep the first one of two at one depth.
uniform sampler2D earlierDepths; // r: the depth that decided
uniform sampler2D earlierIds;    // low and high 24 bits

/// The smaller id is seen of two points at one depth, whichever was drawn first.
bool isBehindEarlier(float key)
{
  ivec2 at = ivec2(gl_FragCoord.xy);
  float earlier = texelFetch(earlierDepths, at, 0).r;
  if (earlier < -1.0e38) // nothing
  {
    return false;
  }
  // As in a depth buffer, nothing is nearer than the eye.
  float behind = max(key, 0.0) - max(earlier, 0.0);
  vec2 before = texelFetch(earlierIds, at, 0).rg;
  bool later = splat.id.y > before.y || (splat.id.y == before.y && splat.id.x >= before.x);
  return behind > 0.0 || (behind == 0.0 && later);
}

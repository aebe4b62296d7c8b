// The sphere around a splat. Twin of SplatSamples.h.
/// Whether the pixel's ray comes near the splat's sphere: near the eye the affine map reaches far
/// beyond what the disc can cover. Twin of LargeSplatAt.
bool isNearSphere(vec2 d)
{
  vec2 ray = d / cameraScale;
  vec2 to = splat.slope.zw;
  float aside = dot(to, ray), offset2 = dot(ray, ray), length2 = 1.0 + dot(to, to);
  float reach = splat.centre.w * 1.01 / splat.centre.z + 1.0 / cameraScale.x;
  return length2 * offset2 - aside * aside <= reach * reach * (length2 + 2.0 * aside + offset2);
}

vec2 sampleSphere(vec2 d)
{
  vec2 ray = d / cameraScale;
  vec2 to = splat.slope.xy;
  float depth = splat.centre.z;
  float aside = dot(to, ray), offset2 = dot(ray, ray);
  float ray2 = POINTFRONT_PARALLEL == 1 ? 1.0 : 1.0 + dot(to, to) + 2.0 * aside + offset2;
  float nearest = POINTFRONT_PARALLEL == 1 ? 0.0 : -depth * (aside + offset2) / ray2;
  float t = depth + nearest;
  vec2 p = POINTFRONT_PARALLEL == 1 ? ray : nearest * to + t * ray;
  float distance2 = dot(p, p) + nearest * nearest;
  float within = max(splat.centre.w * splat.centre.w - distance2, 0.0);
  float front = t - sqrt(within / ray2);
  float q = distance2 * splat.form.x;
  q = inCentrePixel(d) ? min(q, 1.0) : q;
  return vec2(front >= 1.0e-30 ? q : 2.0, front);
}

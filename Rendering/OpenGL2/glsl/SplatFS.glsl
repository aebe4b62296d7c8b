//VTK::System::Dec
// The pixels of a splat. Twin of SplatSamples.h, SplatLoops.h and WinnerResolve.cxx.
//POINTFRONT::Define::Dec
//POINTFRONT::SplatData::Dec
//VTK::Output::Dec

uniform vec2 cameraScale;
uniform vec2 cameraCentre;
uniform float lowPass;     // pixels; 0: none
uniform float paraboloid;  // radii that the rim lies behind the centre
uniform float depthScale;  // scale of the depth buffer
uniform float rimFrom;     // q beyond which a splat is its rim
uniform float rimRadii;    // that the rim lies further back
uniform float mostAtCentre;
uniform vec3 rimColour;
uniform float seenMark, seenLook; // alpha of who is seen (SplatUniforms.cxx), its look
#if POINTFRONT_PASS == 2
uniform sampler2D seenDepths;
uniform float slackRadii;
uniform float slackPixels;
#endif

in SplatData
{
//POINTFRONT::SplatMembers::Dec
} splat;

/// A splat that is smaller than the distance of pixels covers the one it lies in.
bool inCentrePixel(vec2 d)
{
  return all(lessThanEqual(abs(d), vec2(0.5)));
}

/// q (0 at the centre, 1 at the rim) and depth; q beyond 1: not covered.
vec2 sampleEllipse(vec2 d)
{
  float q = (splat.form.x * d.x + splat.form.y * d.y) * d.x + splat.form.z * d.y * d.y;
  q = inCentrePixel(d) ? min(q, mostAtCentre) : q;
  float rise = clamp(dot(splat.slope.xy, d), -splat.centre.w, splat.centre.w);
  return vec2(q, splat.centre.z + rise);
}

vec2 sampleExact(vec2 d)
{
  vec2 ray = d / cameraScale;
  float turned = dot(splat.form.xy, ray);
  float depth = splat.centre.z;
  float further = POINTFRONT_PARALLEL == 1 ? -turned / splat.form.z
                                           : -depth * turned / (splat.form.z + turned);
  float t = depth + further;
  vec2 u = POINTFRONT_PARALLEL == 1 ? ray : further * splat.slope.xy + t * ray;
  float q = (dot(u, u) + further * further) * splat.form.w;
  bool onDisc = q <= 1.0 && t >= 1.0e-30;
  float near = lowPass > 0.0 ? dot(d, d) / (lowPass * lowPass) : 2.0;
  near = inCentrePixel(d) ? min(near, mostAtCentre) : near;
  return onDisc ? vec2(min(q, near), t) : vec2(near, depth);
}

//POINTFRONT::SphereSample::Dec
//POINTFRONT::WallSample::Dec
//POINTFRONT::EarlierSplat::Dec

/// View space, towards the eye; 0: none.
vec3 normalAt(float depth)
{
#if POINTFRONT_SHAPE == 4
  vec2 reach = POINTFRONT_PARALLEL == 1 ? vec2(1.0) : vec2(depth, splat.centre.z);
  vec2 here = (gl_FragCoord.xy - cameraCentre) / cameraScale * reach.x;
  vec2 centre = (splat.centre.xy - cameraCentre) / cameraScale * reach.y;
  return normalize(vec3(here - centre, splat.centre.z - depth));
#else
  vec3 n = vec3(splat.normal.xy, -splat.normal.z);
  float square = dot(n, n);
  bool known = square > 1e-12 && square < 1e12; // as splats have it; not of NaN
  n = known ? n / sqrt(square) : vec3(0.0);
  return n.z < 0.0 ? -n : n;
#endif
}

void main()
{
  vec2 d = gl_FragCoord.xy - splat.centre.xy;
#if POINTFRONT_SHAPE == 0
  vec2 at = gl_FragCoord.xy;
  vec2 inside = step(splat.rectangle.xy, at) * step(at, splat.rectangle.zw);
  vec2 s = vec2(inside.x * inside.y > 0.0 ? 0.0 : 2.0, splat.centre.z);
#elif POINTFRONT_SHAPE == 1
  vec2 s = vec2(splat.form.x * dot(d, d), splat.centre.z);
#elif POINTFRONT_SHAPE == 2
  vec2 s = sampleEllipse(d);
  s.x = POINTFRONT_PARALLEL == 1 || isNearSphere(d) ? s.x : 2.0;
#elif POINTFRONT_SHAPE == 3
  vec2 s = sampleExact(d);
#elif POINTFRONT_SHAPE == 5
  float down;
  vec2 s = sampleWall(d, down);
#else
  vec2 s = sampleSphere(d);
#endif
  if (!(s.x <= 1.0))
  {
    discard;
  }
  float key = s.y + paraboloid * splat.centre.w * s.x;
#if POINTFRONT_SHAPE == 5
  key += wallFall * splat.form.w * down; // the nearest top is seen of walls in one plane
#endif
#if POINTFRONT_PASS == 2
  float pixel = slackPixels / cameraScale.y * (POINTFRONT_PARALLEL == 1 ? 1.0 : splat.centre.z);
  if (key - (slackRadii * splat.centre.w + pixel) >
    texelFetch(seenDepths, ivec2(gl_FragCoord.xy), 0).r)
  {
    discard;
  }
  float weight = floor((1.0 - s.x) * (1.0 - s.x) * (63.0 * splat.colour.a) + 0.5);
  gl_FragData[0] = vec4(floor(splat.colour.rgb * 255.0 + 0.5) * weight, weight);
#else
  vec3 colour = splat.colour.rgb;
#if POINTFRONT_SHAPE == 5
  colour = wallColoured == 1 ? mix(wallUpper, wallLower, down) : colour;
#endif
  if (s.x > rimFrom)
  {
    key += rimRadii * splat.centre.w;
    colour = rimRadii > 0.0 ? rimColour : colour;
  }
#if POINTFRONT_FOLLOWS
  if (isBehindEarlier(key))
  {
    discard;
  }
#endif
  gl_FragDepth = key * depthScale;
  gl_FragData[0] = vec4(colour, seenMark);
  gl_FragData[1] = vec4(key, s.y, seenLook, POINTFRONT_STAND_IN == 1 ? splat.id.x : 0.0);
#if POINTFRONT_LIT
  gl_FragData[2] = vec4(normalAt(s.y), 0.0);
#if POINTFRONT_PICKING
  gl_FragData[3] = vec4(splat.id, 0.0, 0.0);
#endif
#elif POINTFRONT_PICKING
  gl_FragData[2] = vec4(splat.id, 0.0, 0.0);
#endif
#endif
}

//VTK::System::Dec
// Pictures of the parts of a plan, put together. Twin of SoftwareComposition.cxx, Highlights.cxx.
//POINTFRONT::Define::Dec
//VTK::Output::Dec

uniform sampler2D baseColours;
uniform sampler2D baseDepths; // r: from the eye's plane, 3.4e38 where nothing is; g: highlight
#if POINTFRONT_IDS
uniform sampler2D baseIds;
#endif

const float nothingThere = 3.0e38;

vec4 inBytes(vec4 colour)
{
  return floor(clamp(colour * 255.0, 0.0, 255.0) + 0.5) / 255.0;
}

#if POINTFRONT_STEP == 0
// Translucent groups over what is there, far to near.
uniform float opacities[POINTFRONT_COUNT];
//POINTFRONT::Groups::Dec

vec4 over(vec4 front, float opacity, vec4 behind)
{
  float a = opacity * front.a;
  float b = (1.0 - a) * behind.a;
  vec3 mixed = a + b > 0.0 ? (a * front.rgb + b * behind.rgb) / (a + b) : behind.rgb;
  return inBytes(vec4(mixed, a + b));
}

void main()
{
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec4 colour = texelFetch(baseColours, at, 0);
  vec2 depth = texelFetch(baseDepths, at, 0).rg;
  vec4 colours[POINTFRONT_COUNT];
  vec2 depths[POINTFRONT_COUNT];
  vec2 ids[POINTFRONT_COUNT];
  //POINTFRONT::Groups::Impl
  bool blended[POINTFRONT_COUNT];
  for (int i = 0; i < POINTFRONT_COUNT; ++i)
  {
    blended[i] = !(depths[i].r < depth.r);
  }
  int nearest = -1;
  for (int step = 0; step < POINTFRONT_COUNT; ++step)
  {
    int farthest = -1;
    for (int i = 0; i < POINTFRONT_COUNT; ++i)
    {
      bool farther = farthest < 0 || depths[i].r > depths[max(farthest, 0)].r;
      farthest = !blended[i] && farther ? i : farthest;
    }
    if (farthest >= 0)
    {
      colour = over(colours[farthest], opacities[farthest], colour);
      blended[farthest] = true;
      nearest = farthest;
    }
  }
  gl_FragData[0] = colour;
  float left = nearest >= 0 && !(depth.r < nothingThere) ? depths[nearest].r : depth.r;
  gl_FragData[1] = vec4(left, nearest >= 0 ? depths[nearest].g : depth.g, 0.0, 0.0);
#if POINTFRONT_IDS
  vec2 id = texelFetch(baseIds, at, 0).xy;
  gl_FragData[2] = vec4(nearest >= 0 ? ids[nearest] : id, 0.0, 0.0);
#endif
}

#elif POINTFRONT_STEP == 1
// A lens shows what lies inside it.
uniform sampler2D insideColours;
uniform sampler2D insideDepths;
#if POINTFRONT_IDS
uniform sampler2D insideIds;
#endif
uniform sampler2D lensMask;  // shape 2: not 0 where the lens is; 3: depths of what makes it
uniform bool hasInside;
uniform int lensShape;       // LensShape
uniform vec2 lensCentre;     // pixels
uniform vec2 lensHalfSize;
uniform ivec2 viewportSize;

bool covered(ivec2 at)
{
  vec2 from = vec2(at) + 0.5 - lensCentre;
  if (lensShape == 0)
  {
    vec2 a = from * from, b = lensHalfSize * lensHalfSize;
    return a.x * b.y + a.y * b.x <= b.x * b.y;
  }
  if (lensShape == 1)
  {
    return all(lessThanEqual(abs(from), lensHalfSize));
  }
  if (lensShape == 2)
  {
    return texelFetch(lensMask, at * textureSize(lensMask, 0) / viewportSize, 0).r > 0.0;
  }
  return texelFetch(lensMask, at, 0).r < nothingThere;
}

void main()
{
  ivec2 at = ivec2(gl_FragCoord.xy);
  bool inside = covered(at);
  bool shown = inside && hasInside;
  gl_FragData[0] = shown ? texelFetch(insideColours, at, 0)
    : inside             ? vec4(0.0)
                         : texelFetch(baseColours, at, 0);
  gl_FragData[1] = shown ? texelFetch(insideDepths, at, 0)
    : inside             ? vec4(3.4e38, 0.0, 0.0, 0.0)
                         : texelFetch(baseDepths, at, 0);
#if POINTFRONT_IDS
  gl_FragData[2] = shown ? texelFetch(insideIds, at, 0) : texelFetch(baseIds, at, 0);
#endif
}

#else
// A highlight: its pixels are tinted, and it has a rim on everything behind it.
//POINTFRONT::Highlight::Dec
#endif

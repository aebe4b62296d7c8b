//VTK::System::Dec
// What is seen with a layer of a refining view. Stand-ins of one level show where nothing is, or
// only what lies far behind them: twin of WinnerResolve::put(). What grows shows where it is
// nearest.
//POINTFRONT::Define::Dec
//VTK::Output::Dec

uniform sampler2D seenColours;
uniform sampler2D seenDepths;
uniform sampler2D layerColours;
uniform sampler2D layerDepths;    // a, of stand-ins: number of the node
#if POINTFRONT_STAND_INS
uniform samplerBuffer layerNodes; // r: radius, world units, negative: not to be seen; g: least
                                  // radius at depth 1
#endif
#if POINTFRONT_LIT
uniform sampler2D seenNormals;
uniform sampler2D layerNormals;
#endif

#if POINTFRONT_STAND_INS
const float standInRadii = 2.0;

bool isBefore(vec4 layer, vec4 seen, bool nothing)
{
  vec2 node = texelFetch(layerNodes, int(layer.a + 0.5)).rg;
  float reach = POINTFRONT_PARALLEL == 1 ? 1.0 : layer.g;
  float slack = standInRadii * max(node.r, node.g * reach);
  return node.r >= 0.0 && (nothing || layer.g + slack < seen.g);
}
#else
bool isBefore(vec4 layer, vec4 seen, bool nothing)
{
  return nothing || layer.r < seen.r;
}
#endif

void main()
{
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec4 seen = texelFetch(seenColours, at, 0);
  vec4 depths = texelFetch(seenDepths, at, 0);
  vec4 colour = texelFetch(layerColours, at, 0);
  vec4 layer = texelFetch(layerDepths, at, 0);
  bool shown = colour.a > 0.0 && isBefore(layer, depths, seen.a == 0.0);
#if POINTFRONT_STAND_INS
  float mark = floor(colour.a * 255.0 + 0.5); // no sum is its colour
  colour.a = (mark > 127.0 ? mark - 128.0 : mark) / 255.0;
#endif
  gl_FragData[0] = shown ? colour : seen;
  gl_FragData[1] = shown ? layer : depths;
#if POINTFRONT_LIT
  vec4 normal = texelFetch(seenNormals, at, 0);
  gl_FragData[2] = shown ? texelFetch(layerNormals, at, 0) : normal;
#endif
}

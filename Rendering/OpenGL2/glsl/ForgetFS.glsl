//VTK::System::Dec
// Sums of a refining view begin anew where something came that is much nearer than what was seen.
// Twin of RasterPasses::goOnWithSums().
//POINTFRONT::Define::Dec
//VTK::Output::Dec

uniform sampler2D seenDepths;
uniform sampler2D lastDepths;
uniform float forgottenDepth; // at depth 1

void main()
{
  ivec2 at = ivec2(gl_FragCoord.xy);
  float depth = texelFetch(seenDepths, at, 0).r;
  float reach = POINTFRONT_PARALLEL == 1 ? 1.0 : depth;
  if (!(depth < texelFetch(lastDepths, at, 0).r - forgottenDepth * reach))
  {
    discard;
  }
  gl_FragData[0] = vec4(0.0);
}

//VTK::System::Dec
// The fragments of points: VTK's template for polygonal mappers, coloured by PointsVS.glsl.
//POINTFRONT::Define::Dec
#ifndef POINTFRONT_PICKING
#define POINTFRONT_PICKING 0
#endif
#ifndef POINTFRONT_SQUARES
#define POINTFRONT_SQUARES 0
#endif

uniform int PrimitiveIDOffset;

in vec4 vertexColorVSOutput;
uniform float ambientIntensity;
uniform float diffuseIntensity;
uniform float specularIntensity;
uniform float specularPowerUniform;
uniform float opacityUniform;
uniform vec3 specularColorUniform;
#if POINTFRONT_PICKING
flat in ivec2 pointIdVSOutput; // low and high 24 bits
#endif
#if POINTFRONT_SQUARES
flat in vec4 shownPixelsVSOutput; // low and high corner
#endif

//VTK::CustomUniforms::Dec
//VTK::PositionVC::Dec
//VTK::Camera::Dec
//VTK::Color::Dec
//VTK::Normal::Dec
//VTK::Light::Dec
//VTK::TMap::Dec
//VTK::TCoord::Dec
//VTK::Picking::Dec
//VTK::DepthPeeling::Dec
//VTK::Clip::Dec
//VTK::Output::Dec
//VTK::PrimID::Dec
//VTK::Coincident::Dec
//VTK::ValuePass::Dec
//VTK::Edges::Dec

void main()
{
#if POINTFRONT_SQUARES
  if (any(lessThan(gl_FragCoord.xy, shownPixelsVSOutput.xy)) ||
    any(greaterThan(gl_FragCoord.xy, shownPixelsVSOutput.zw)))
  {
    discard;
  }
#endif
  //VTK::PositionVC::Impl
  //VTK::UniformFlow::Impl
  //VTK::Depth::Impl
  //VTK::DepthPeeling::PreColor
  //VTK::PrimID::Impl
  //VTK::Clip::Impl
  //VTK::ValuePass::Impl

  vec3 ambientColor = ambientIntensity * vertexColorVSOutput.rgb;
  vec3 diffuseColor = diffuseIntensity * vertexColorVSOutput.rgb;
  vec3 specularColor = specularIntensity * specularColorUniform;
  float specularPower = specularPowerUniform;
  float opacity = opacityUniform * vertexColorVSOutput.a;
  //VTK::Color::Impl
  //VTK::Edges::Impl
  //VTK::Normal::Impl
  //VTK::Light::Impl
  //VTK::TCoord::Impl

  if (gl_FragData[0].a <= 0.0)
  {
    discard;
  }
  //VTK::DepthPeeling::Impl
  //VTK::Picking::Impl
  //VTK::Coincident::Impl
}

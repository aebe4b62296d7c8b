//VTK::System::Dec
// The fragments of points: VTK's template for polygonal mappers, coloured by PointsVS.glsl.
//POINTFRONT::Define::Dec
#ifndef POINTFRONT_PICKING
#define POINTFRONT_PICKING 0
#endif

uniform int PrimitiveIDOffset;

in vec4 vertexColorVSOutput; // a < 0: the property's colour
uniform float ambientIntensity;
uniform float diffuseIntensity;
uniform float specularIntensity;
uniform float specularPowerUniform;
uniform float opacityUniform;
uniform vec3 ambientColorUniform;
uniform vec3 diffuseColorUniform;
uniform vec3 specularColorUniform;
#if POINTFRONT_PICKING
flat in ivec2 pointIdVSOutput; // low and high 24 bits
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
  //VTK::PositionVC::Impl
  //VTK::UniformFlow::Impl
  //VTK::Depth::Impl
  //VTK::DepthPeeling::PreColor
  //VTK::PrimID::Impl
  //VTK::Clip::Impl
  //VTK::ValuePass::Impl

  bool coloured = vertexColorVSOutput.a >= 0.0;
  vec3 ambientColor = ambientIntensity * (coloured ? vertexColorVSOutput.rgb : ambientColorUniform);
  vec3 diffuseColor = diffuseIntensity * (coloured ? vertexColorVSOutput.rgb : diffuseColorUniform);
  vec3 specularColor = specularIntensity * specularColorUniform;
  float specularPower = specularPowerUniform;
  float opacity = opacityUniform * (coloured ? vertexColorVSOutput.a : 1.0);
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

//VTK::System::Dec
// A picture that was drawn without GL, as if its pixels were fragments of geometry: other actors,
// passes and selections see colour and depth as any mapper's.
//POINTFRONT::Define::Dec
#ifndef POINTFRONT_PICKING
#define POINTFRONT_PICKING 0
#endif

uniform sampler2D pictureColour;
uniform sampler2D pictureDepth;   // world units from the eye's plane; infinite where nothing is
#if POINTFRONT_PICKING
uniform sampler2D pictureIds;     // low and high 24 bits
#endif
uniform ivec2 pictureOrigin;      // corner of the viewport, pixels of the framebuffer
uniform ivec2 pictureCorner;      // corner of the textures in the viewport, pixels
uniform vec2 pictureSize;         // size of the viewport, pixels
uniform mat4 pictureViewToClip;
uniform float pictureOffset;      // for coincident topology: a part of the range of depths
uniform int cameraParallel;       // for code of render passes

uniform float ambientIntensity;
uniform float diffuseIntensity;
uniform float opacityUniform;

//VTK::CustomUniforms::Dec
//VTK::Light::Dec
//VTK::Picking::Dec
//VTK::DepthPeeling::Dec
//VTK::Output::Dec
//VTK::ValuePass::Dec

/// View coordinates of a window position (pixels of the viewport) at a depth: the inverse of any
/// frustum, off-axis ones included.
vec4 viewAt(vec2 windowPx, float depth)
{
  mat4 m = pictureViewToClip;
  vec2 ndc = 2.0 * windowPx / pictureSize - 1.0;
  float w = -m[2][3] * depth + m[3][3];
  vec2 clip = ndc * w + vec2(m[2][0], m[2][1]) * depth - vec2(m[3][0], m[3][1]);
  return vec4(clip.x / m[0][0], clip.y / m[1][1], -depth, 1.0);
}

void main()
{
  vec2 windowPx = gl_FragCoord.xy - vec2(pictureOrigin);
  ivec2 texel = ivec2(floor(windowPx)) - pictureCorner;
  float depth = texelFetch(pictureDepth, texel, 0).r;
  if (!(depth < 3.0e38))
  {
    discard;
  }
  vec4 vertexVC = viewAt(windowPx, depth);
  vec3 normalVCVSOutput = vec3(0.0, 0.0, 1.0); // towards the eye, as VTK's points have it
  float clipZ = pictureViewToClip[3][2] - pictureViewToClip[2][2] * depth;
  float clipW = pictureViewToClip[3][3] - pictureViewToClip[2][3] * depth;
  gl_FragDepth = 0.5 * clipZ / clipW + 0.5 + pictureOffset;
  //VTK::UniformFlow::Impl
  //VTK::DepthPeeling::PreColor
  //VTK::ValuePass::Impl

  vec4 seen = texelFetch(pictureColour, texel, 0);
  vec3 colour = (ambientIntensity + diffuseIntensity) * seen.rgb;
  float opacity = opacityUniform * seen.a; // below 1 where only what is translucent is
  //VTK::Light::Impl

  //VTK::DepthPeeling::Impl
  //VTK::Picking::Impl
}

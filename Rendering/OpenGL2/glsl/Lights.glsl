// Colours in the light of the frame. Twin of Shading.cxx.

/// To bytes and back, as each step of the software back end.
vec3 inBytes(vec3 colour)
{
  return floor(clamp(colour * 255.0 + 0.5, 0.0, 255.0)) / 255.0;
}

/// FrameShading::look(): ambient, -1 without light; diffuse; strength of eye-dome lighting with its
/// gain, 0 without; its radius in pixels.
uniform vec4 looks[POINTFRONT_LOOKS];

vec4 lookOf(float number)
{
  return looks[POINTFRONT_LOOKS == 1 ? 0 : clamp(int(number + 0.5), 0, POINTFRONT_LOOKS - 1)];
}

#if POINTFRONT_LIT
uniform sampler2D seenNormals;
uniform int lightCount;
uniform vec4 lightPlaces[48];     // a = 0: towards the light, unit; 1: where it is in view space
uniform vec4 lightColours[48];    // a: exponent of the cone
uniform vec4 lightAims[48];       // middle of the cone, unit; a: cosine of its angle, -2: none
uniform vec3 lightAttenuations[48];
uniform mat4 viewToClip;
uniform vec2 viewportSize;

/// Where the pixel's centre is at a depth: the inverse of any frustum.
vec3 placeAt(vec2 windowPx, float depth)
{
  mat4 m = viewToClip;
  vec2 clip = (2.0 * windowPx / viewportSize - 1.0) * (m[3][3] - m[2][3] * depth);
  vec2 view = clip + vec2(m[2][0], m[2][1]) * depth - vec2(m[3][0], m[3][1]);
  return vec3(view / vec2(m[0][0], m[1][1]), -depth);
}

float brightness(int i, float depth, vec3 normal)
{
  if (lightPlaces[i].a == 0.0)
  {
    return max(dot(normal, lightPlaces[i].xyz), 0.0);
  }
  vec3 from = placeAt(gl_FragCoord.xy, depth) - lightPlaces[i].xyz;
  float distance = max(length(from), 1.2e-38);
  vec3 ray = from / distance;
  vec3 fall = lightAttenuations[i];
  float share = max(-dot(normal, ray), 0.0) /
    max(fall.x + fall.y * distance + fall.z * distance * distance, 1.0e-30);
  float cosine = dot(ray, lightAims[i].xyz);
  float cone = cosine >= lightAims[i].a ? pow(max(cosine, 0.0), lightColours[i].a) : 0.0;
  return lightAims[i].a == -2.0 ? share : share * cone;
}

/// `depth`: from the eye's plane.
vec3 litColour(vec3 colour, ivec2 at, float depth, vec4 look)
{
  vec3 n = texelFetch(seenNormals, at, 0).xyz;
  if (n == vec3(0.0) || look.x < 0.0)
  {
    return colour;
  }
  vec3 sum = vec3(look.x);
  for (int i = 0; i < lightCount; ++i)
  {
    sum += lightColours[i].rgb * (look.y * brightness(i, depth, n));
  }
  return inBytes(colour * sum);
}
#endif

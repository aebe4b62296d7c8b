// A point that was visible in an earlier picture, as CaptureGS.glsl wrote it (SMOOTH-7).
in vec3 keptPlace; // camera space of the frame that it was captured in
in float keptRadius;
in vec4 keptColour;
in vec3 keptNormal;
in vec2 keptId;

uniform mat4 keptToCamera;
uniform mat3 keptNormals;    // the same of normals
uniform float keptShare;     // share of its radius, in this pass
uniform float radiusFactor;

Point pointOf()
{
  Point point;
  point.camera = (keptToCamera * vec4(keptPlace, 1.0)).xyz;
  point.grown = 1.0;
  point.colour = keptColour;
  point.normal = keptNormals * keptNormal;
  point.id = keptId;
  point.drawn = true;
#if POINTFRONT_RADIUS == 0
  float depth = POINTFRONT_PARALLEL == 1 ? 1.0 : point.camera.z;
  point.radius = radiusFactor / cameraScale.y * depth;
#elif POINTFRONT_RADIUS == 1
  point.radius = radiusFactor;
#else
  point.radius = keptRadius * keptShare;
#endif
  return point;
}

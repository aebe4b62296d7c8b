// A stored point, by the slots of a GpuPool. Positions are integers (docs/adr/0004).
in uvec3 positionSteps; // grid steps from the node's origin
#if POINTFRONT_COLOUR == 1
in vec4 pointColour;
#elif POINTFRONT_COLOUR == 2
in float pointValue;    // world value - the colouring's base
#endif
#if POINTFRONT_SHAPED
in uint pointShape;     // ShapeCode.h
#endif
#if POINTFRONT_RADIUS == 4
in float pointSize;     // radius, store units
#endif

uniform int slotPoints;            // vertices of a slot
uniform int firstSlot;             // first slot of the buffers that are drawn from
uniform isamplerBuffer slotSteps;  // xyz: the reference in the node's steps; w: shift and flags
uniform samplerBuffer slotPlaces;  // camera space of the reference; w: size of the first point
uniform samplerBuffer slotRadii;   // closing radius, scale of own ones, 1: none below, sparsest
uniform isamplerBuffer slotIds;    // low and high 24 bits of the id of the slot's first point; z:
                                   // number of its node, of stand-ins
uniform samplerBuffer slotBase;    // store units; w: what sizes fall by from a point to the next
#if POINTFRONT_COLOUR == 3
uniform vec3 stepSize;
#endif
uniform mat3 stepsToCamera;
uniform mat3 normalToCamera;
uniform vec3 fixedNormal;          // camera space, of points without one; 0: none
uniform vec4 flatColour;           // colour of points without a value
uniform int styleMark;
uniform float radiusFactor;        // factor of the store's radius, for splats of this pass
uniform float radiusBase;          // base of codes, store units

//POINTFRONT::ColourMapTexture::Dec

vec4 colourOf(int flags, int slot, int height, int shift)
{
#if POINTFRONT_COLOUR == 3
  return heightColour(height, shift, stepSize.z, texelFetch(slotBase, slot).z);
#elif POINTFRONT_COLOUR == 1
  return (flags & 256) != 0 ? pointColour : flatColour;
#elif POINTFRONT_COLOUR == 2
  return (flags & 256) != 0 ? tableColour(pointValue) : flatColour;
#else
  return flatColour;
#endif
}

/// Twin of PointShapes::fill.
float radiusOf(int flags, int slot, float depth)
{
  vec4 node = texelFetch(slotRadii, slot);
  float closing = node.x * radiusFactor;
#if POINTFRONT_RADIUS == 0
  return radiusFactor / cameraScale.y * (POINTFRONT_PARALLEL == 1 ? 1.0 : depth);
#elif POINTFRONT_RADIUS == 1
  return radiusFactor;
#elif POINTFRONT_RADIUS == 3
  uint code = (flags & 512) != 0 ? pointShape & 255u : 0u;
  float own = radiusBase * exp2((float(code) - 128.0) / 16.0) * radiusFactor * node.y;
  float most = 4.0 * max(closing, node.w * radiusFactor);
  float known = code != 0u && radiusBase > 0.0 ? min(own, most) : closing;
  return max(known, node.z * closing);
#elif POINTFRONT_RADIUS == 4
  return (flags & 1024) != 0 ? pointSize * radiusFactor : closing;
#else
  return closing;
#endif
}

vec3 normalOf(int flags)
{
#if POINTFRONT_NORMALS
  uint across = pointShape >> 8 & 4095u;
  if ((flags & 512) != 0 && across != 4095u)
  {
    vec2 e = (vec2(float(across), float(pointShape >> 20)) - 2047.0) / 2047.0;
    vec3 n = vec3(e, 1.0 - abs(e.x) - abs(e.y));
    vec2 folded = (1.0 - abs(e.yx)) * vec2(e.x < 0.0 ? -1.0 : 1.0, e.y < 0.0 ? -1.0 : 1.0);
    return normalToCamera * (n.z < 0.0 ? vec3(folded, n.z) : n);
  }
#endif
  return fixedNormal;
}

Point pointOf()
{
  Point point;
  int slot = firstSlot + gl_VertexID / slotPoints;
  ivec4 steps = texelFetch(slotSteps, slot);
  int shift = steps.w & 255;
  ivec3 difference = ivec3(positionSteps >> uint(shift)) - steps.xyz;
  float width = exp2(float(shift));
  vec4 place = texelFetch(slotPlaces, slot);
  point.camera = stepsToCamera * (vec3(difference) * width) + place.xyz;
  float fall = texelFetch(slotBase, slot).w; // twin of PointGrowth.h
  point.grown = clamp(place.w - fall * float(gl_VertexID % slotPoints), 0.0, 1.0);
  point.colour = colourOf(steps.w, slot, difference.z, shift);
  point.drawn = true;
#if POINTFRONT_MARKED
  point.drawn = (steps.w & 256) != 0 && int(point.colour.a * 255.0 + 0.5) == styleMark;
#endif
  point.normal = normalOf(steps.w);
  ivec3 id = texelFetch(slotIds, slot).xyz;
#if POINTFRONT_STAND_IN
  point.id = vec2(float(id.z), 0.0);
#else
  int low = id.x + gl_VertexID % slotPoints;
  point.id = vec2(float(low & 0xffffff), float(id.y + (low >> 24)));
#endif
  point.radius = radiusOf(steps.w, slot, point.camera.z);
  return point;
}

//VTK::System::Dec
// The points of a store's nodes. Positions are integers; see docs/adr/0004.
//   MC   the store's coordinates (before the actor's matrix), relative to the frame's reference
//        point (the eye; for a parallel view the focal point): float is enough near it.
// POINTFRONT_COLOUR  0 one colour, 1 colours, 2 values for the table, 3 elevation
// POINTFRONT_PICKING 1 in passes that draw point ids
// POINTFRONT_SQUARES 1 where points are larger than a pixel
//POINTFRONT::Define::Dec
#ifndef POINTFRONT_COLOUR
#define POINTFRONT_COLOUR 0
#endif
#ifndef POINTFRONT_PICKING
#define POINTFRONT_PICKING 0
#endif
#ifndef POINTFRONT_SQUARES
#define POINTFRONT_SQUARES 0
#endif

in uvec3 positionSteps; // grid steps from the node's origin
#if POINTFRONT_COLOUR == 1
in vec4 pointColour;
#elif POINTFRONT_COLOUR == 2
in float pointValue; // world value - the colouring's base
#endif

uniform int slotPoints;            // vertices of a slot
uniform int firstSlot;             // first slot of the buffers that are drawn from
uniform isamplerBuffer slotSteps;  // xyz: the reference in the node's steps; w: shift, flag << 8
uniform samplerBuffer slotBase;    // xyz: what rounding of the reference left over, MC
uniform vec3 stepSize;             // MC units of a grid step

uniform vec4 flatColour;           // colour of points without a value

out vec4 vertexColorVSOutput;
invariant gl_Position;             // in all variants: passes compare depths of each other

#if POINTFRONT_PICKING
uniform isamplerBuffer slotIds;    // x, y: low and high 24 bits of the id of the slot's first point
flat out ivec2 pointIdVSOutput;
#endif

#if POINTFRONT_SQUARES
uniform float squareEdge;          // pixels
uniform vec4 viewportPx;           // corner and size in the window
flat out vec4 shownPixelsVSOutput; // low and high corner
#endif

//VTK::CustomUniforms::Dec
//VTK::PositionVC::Dec
//VTK::Normal::Dec
//VTK::Light::Dec
//VTK::TCoord::Dec
//VTK::Color::Dec
//VTK::Clip::Dec
//VTK::Camera::Dec
//VTK::PrimID::Dec
//VTK::ValuePass::Dec
//VTK::Picking::Dec

#if POINTFRONT_COLOUR >= 2
//POINTFRONT::ColourMapTexture::Dec
#endif

/// The difference is taken in integers, where it is exact; only then it becomes float.
ivec3 differenceOf(ivec4 steps)
{
  return ivec3(positionSteps >> uint(steps.w & 255)) - steps.xyz;
}

vec3 positionMC(ivec4 steps, vec3 base)
{
  return vec3(differenceOf(steps)) * (stepSize * exp2(float(steps.w & 255))) + base;
}

#if POINTFRONT_SQUARES
/// GL drops points whose centre is beside the viewport, however far they reach into it: they are
/// moved to its border, where fragments outside of their own square are discarded. What of a square
/// is in the viewport lies within half an edge of the border, so that the moved one covers it.
void pullIntoViewport()
{
  shownPixelsVSOutput = vec4(-1.0e9, -1.0e9, 1.0e9, 1.0e9);
  bvec2 moved = greaterThan(abs(gl_Position.xy), gl_Position.ww);
  if (gl_Position.w <= 0.0 || !any(moved))
  {
    return;
  }
  vec2 place = gl_Position.xy / gl_Position.w;
  vec2 centre = viewportPx.xy + (0.5 + 0.5 * place) * viewportPx.zw;
  vec2 corner = floor(centre - 0.5 * (squareEdge - 1.0)); // as in SplatSetUp.glsl
  bvec2 reaches = lessThan(max(corner, viewportPx.xy),
    min(corner + squareEdge, viewportPx.xy + viewportPx.zw));
  if (all(reaches))
  {
    // Along the other axis GL's own rounding decides, as for all points.
    shownPixelsVSOutput.xy = mix(shownPixelsVSOutput.xy, corner, moved);
    shownPixelsVSOutput.zw = mix(shownPixelsVSOutput.zw, corner + squareEdge, moved);
    gl_Position.xy = mix(gl_Position.xy, sign(place) * gl_Position.w, moved);
  }
}
#endif

void main()
{
  //VTK::CustomBegin::Impl
  int slot = firstSlot + gl_VertexID / slotPoints;
  ivec4 steps = texelFetch(slotSteps, slot);
  vec4 vertexMC = vec4(positionMC(steps, texelFetch(slotBase, slot).xyz), 1.0);

  vertexColorVSOutput = flatColour;
#if POINTFRONT_COLOUR == 3
  vertexColorVSOutput = heightColour(
    differenceOf(steps).z, steps.w & 255, stepSize.z, texelFetch(slotBase, slot).z);
#elif POINTFRONT_COLOUR > 0
  if ((steps.w & 256) != 0)
  {
#if POINTFRONT_COLOUR == 1
    vertexColorVSOutput = pointColour;
#else
    vertexColorVSOutput = tableColour(pointValue);
#endif
  }
#endif
  //VTK::Color::Impl
  //VTK::Normal::Impl
  //VTK::TCoord::Impl
  //VTK::Clip::Impl
  //VTK::PrimID::Impl
  //VTK::PositionVC::Impl
  //POINTFRONT::PositionVC::Impl
  //VTK::ValuePass::Impl
  //VTK::Light::Impl
#if POINTFRONT_PICKING
  ivec2 id = texelFetch(slotIds, slot).xy;
  int low = id.x + gl_VertexID % slotPoints;
  pointIdVSOutput = ivec2(low & 0xffffff, id.y + (low >> 24));
#endif
  //VTK::Picking::Impl
#if POINTFRONT_SQUARES
  pullIntoViewport();
#endif
  //VTK::CustomEnd::Impl
}

//VTK::System::Dec
// A rectangle of the viewport, of no vertex buffer.

uniform vec4 pictureEdges;        // clip space: left, bottom, right, top

void main()
{
  vec2 corner = vec2((gl_VertexID & 1) == 0 ? pictureEdges.x : pictureEdges.z,
    gl_VertexID < 2 ? pictureEdges.y : pictureEdges.w);
  gl_Position = vec4(corner, 0.0, 1.0);
}

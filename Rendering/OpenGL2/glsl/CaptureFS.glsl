//VTK::System::Dec
//VTK::Output::Dec
// Never runs: capturing draws nothing.
void main()
{
  gl_FragData[0] = vec4(0.0);
}

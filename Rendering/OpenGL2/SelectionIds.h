#pragma once

#include <vtkHardwareSelector.h>
#include <vtkShader.h>
#include <vtkShaderProgram.h>

#include <map>
#include <string>

namespace pointfront
{

/// Whether a pass of a selection wants ids of points; `state`: a vtkHardwareSelector pass.
inline bool drawsIds(int state)
{
  return state >= vtkHardwareSelector::POINT_ID_LOW24 && state != vtkHardwareSelector::PROCESS_PASS;
}

/// Writes 24 of an id's 48 bits as a colour; `id`: a GLSL ivec2 of its low and high 24 bits.
inline void replacePicking(
  const std::map<vtkShader::Type, vtkShader*>& shaders, int state, const std::string& id)
{
  const bool high =
    state == vtkHardwareSelector::POINT_ID_HIGH24 || state == vtkHardwareSelector::CELL_ID_HIGH24;
  std::string source = shaders.at(vtkShader::Fragment)->GetSource();
  vtkShaderProgram::Substitute(source, "//VTK::Picking::Impl",
    "  ivec3 idBytes = (ivec3(" + id + (high ? ".y" : ".x") +
      ") >> ivec3(0, 8, 16)) & 255;\n"
      "  gl_FragData[0] = vec4(vec3(idBytes) / 255.0, 1.0);\n");
  shaders.at(vtkShader::Fragment)->SetSource(source);
}

} // namespace pointfront

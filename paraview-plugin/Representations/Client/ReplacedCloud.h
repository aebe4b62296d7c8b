#pragma once

class vtkSMSessionProxyManager;

namespace pointfront
{

/// ParaView's application hides the input of a filter that is applied, if the filter's definition
/// says so: always, or where the input is shown as a surface (Clip, Slice, Threshold ...). A cloud
/// is no surface. From now on each filter of this session that is made for a cloud says "always".
/// May be called any number of times. Client only.
void letFiltersReplaceClouds(vtkSMSessionProxyManager* session);

} // namespace pointfront

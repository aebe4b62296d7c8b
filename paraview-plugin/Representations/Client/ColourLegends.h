#pragma once

class vtkSMProxy;

namespace pointfront
{

/// Hides the legends (ParaView's scalar bars) of a view whose colour map draws nothing there:
/// those of "rgb" where Point Front draws it as it is, and of arrays that are no colours. One that
/// something else in the view is drawn through stays. Client only.
void hideUnusedLegends(vtkSMProxy* view);

} // namespace pointfront

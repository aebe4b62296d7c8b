#pragma once

#include <string>
#include <vector>

class vtkSMProxy;

namespace pointfront
{

/// Makes the colour map of a representation that shows "classification" one of categories, with
/// names and colours of the ASPRS: of the classes that the cloud has, `classes` by their names.
/// Clouds that share a map add theirs. Without `classes`, each code in the range of the data. What
/// a user makes of the map stays: of names, all; of colours, those that are there. Client only.
void nameClasses(vtkSMProxy* representation, const std::vector<std::string>& classes);

} // namespace pointfront

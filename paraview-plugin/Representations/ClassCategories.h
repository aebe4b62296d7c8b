#pragma once

class vtkSMProxy;

namespace pointfront
{

/// Makes the colour map of a representation that shows "classification" one of categories: the
/// codes that the data has, with names and colours of the ASPRS. Once for each map: what a user
/// makes of it afterwards stays. Client only.
void nameClasses(vtkSMProxy* representation);

} // namespace pointfront

#pragma once

#include "HttpTransfer.h"

#include <chrono>
#include <string>

namespace pointfront
{

/// The pause that a server asks for (Retry-After), half a minute at most; dates are not read, since
/// its clock is not ours.
std::chrono::milliseconds askedPause(const HttpAnswer& answer);

/// How long a server promises that the file stays what it is: `immutable` (RFC 8246) for as long as
/// `max-age` says (RFC 9111), a year at most, less the time that a cache on the way has had it.
/// Zero without both: a file that is merely fresh may be another one by now.
std::chrono::seconds unchangedFor(const HttpAnswer& answer);

/// An object store's name of a fault (<Code>ExpiredToken</Code>). Empty: it gives none, or none
/// that may stand in a message.
std::string faultCode(const HttpAnswer& answer);
/// The region of the bucket, if an object store says that another one was asked; or empty.
std::string bucketRegion(const HttpAnswer& answer);

} // namespace pointfront

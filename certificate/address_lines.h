#pragma once

#include <string>
#include <vector>

#include "certificate/certificate_data.h"

namespace gumcert::certificate {

/// An address as it is printed, without the country: its lines, then those that its named parts make. Empty: nothing is stated.
///
/// "Example Street 1", "PO Box 7", "12345 Example Town, Region"; where the country writes the number before the street and
/// the postcode behind the town (AU, CA, GB, IE, IN, NZ, US): "1 Example Street", "PO Box 7", "Example Town, Region 12345".
/// An address in another order is stated in `lines`.
[[nodiscard]] std::vector<std::string> address_lines(const Address& address);

}  // namespace gumcert::certificate

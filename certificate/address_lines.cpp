#include "certificate/address_lines.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

namespace gumcert::certificate {

namespace {

constexpr std::array<std::string_view, 7> k_number_before_street{"AU", "CA", "GB", "IE", "IN", "NZ", "US"};

/// Two parts with something between them where both are there.
std::string joined(const std::string& first, const char* between, const std::string& second) {
    return first.empty() || second.empty() ? first + second : first + between + second;
}

}  // namespace

std::vector<std::string> address_lines(const Address& address) {
    const bool before = std::find(k_number_before_street.begin(), k_number_before_street.end(), address.country) !=
                        k_number_before_street.end();
    std::vector<std::string> lines = address.lines;
    for (std::string line :
         {before ? joined(address.street_no, " ", address.street) : joined(address.street, " ", address.street_no),
          address.post_office_box,
          before ? joined(joined(address.city, ", ", address.state), " ", address.postcode)
                 : joined(joined(address.postcode, " ", address.city), ", ", address.state)}) {
        if (!line.empty()) {
            lines.push_back(std::move(line));
        }
    }
    return lines;
}

}  // namespace gumcert::certificate

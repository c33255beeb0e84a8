#include "text/degrees_of_freedom.h"

namespace gumcert::text {

std::string degrees_of_freedom(const std::string& printed) {
    return printed + (printed == "1" ? " degree of freedom" : " degrees of freedom");
}

}  // namespace gumcert::text

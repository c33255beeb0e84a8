#include "json/step.h"

#include "json/json_pointer.h"

namespace gumcert::json {

std::string Step::pointer() const {
    if (outer == nullptr) {
        return "";
    }
    return index ? child_pointer(outer->pointer(), *index) : child_pointer(outer->pointer(), key);
}

}  // namespace gumcert::json

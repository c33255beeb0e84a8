#include "engine/degrees_text.h"

#include "text/numbers.h"

namespace gumcert::engine {

std::string degrees_text(double degrees) {
    return text::shortest(degrees) + "°";
}

}  // namespace gumcert::engine

#pragma once

#include <functional>
#include <string>

namespace gumcert::gum {

/// Called now and then during long work with a sentence on what is being done; empty: nobody asks.
using Progress = std::function<void(const std::string&)>;

}  // namespace gumcert::gum

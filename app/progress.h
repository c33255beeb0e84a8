#pragma once

#include <functional>
#include <string>

namespace gumcert::app {

/// Called now and then with a sentence on what is being done; empty: nobody asks.
using Progress = std::function<void(const std::string&)>;

}  // namespace gumcert::app

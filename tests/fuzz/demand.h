#pragma once

#include <stdexcept>

namespace gumcert::fuzz {

/// What must hold for any bytes. The exception ends a fuzz target, and fails a test that replays its corpus.
inline void demand(bool holds, const char* what) {
    if (!holds) {
        throw std::logic_error(what);
    }
}

}  // namespace gumcert::fuzz

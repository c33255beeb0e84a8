#include "gum/quantity/matrix_blocks.h"

#include <Eigen/Core>

namespace {

bool tell_eigen() {
    Eigen::setCpuCacheSizes(gumcert::gum::k_first_level_cache, gumcert::gum::k_second_level_cache,
                            gumcert::gum::k_third_level_cache);
    return true;
}

}  // namespace

// A linker takes what is asked for out of a library: CMakeLists.txt asks for this name.
extern "C" {
extern const bool gumcert_matrix_blocks_are_fixed;
const bool gumcert_matrix_blocks_are_fixed = tell_eigen();
}

#include "gum/quantity/matrix_blocks.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cstddef>

namespace gumcert::gum {
namespace {

TEST(MatrixBlocks, AreThoseOfTheProgramOnEveryProcessor) {
    EXPECT_EQ(Eigen::l1CacheSize(), k_first_level_cache);
    EXPECT_EQ(Eigen::l2CacheSize(), k_second_level_cache);
    EXPECT_EQ(Eigen::l3CacheSize(), k_third_level_cache);
}

/// Sums that nobody rounds twice alike: a product of matrices that are larger than a block.
Eigen::MatrixXd product() {
    constexpr Eigen::Index k_rows = 70, k_inner = 900, k_columns = 60;
    const auto entry = [](Eigen::Index i, Eigen::Index j) {
        return 1.0 / (1.0 + static_cast<double>((37 * i + 101 * j) % 997));
    };
    return Eigen::MatrixXd::NullaryExpr(k_rows, k_inner, entry) *
           Eigen::MatrixXd::NullaryExpr(k_inner, k_columns, entry);
}

// What this file is for. Should a later Eigen divide products by something else than the sizes of caches, this fails, and
// somebody has to look what it is.
TEST(MatrixBlocks, DecideTheLastBitsOfAProduct) {
    const Eigen::MatrixXd here = product();
    Eigen::setCpuCacheSizes(std::ptrdiff_t{32} << 10U, k_second_level_cache, k_third_level_cache);
    const Eigen::MatrixXd there = product();
    Eigen::setCpuCacheSizes(k_first_level_cache, k_second_level_cache, k_third_level_cache);
    EXPECT_TRUE((here.array() != there.array()).any());
    EXPECT_TRUE(here.isApprox(there, 1e-14));
    EXPECT_TRUE((here.array() == product().array()).all());
}

}  // namespace
}  // namespace gumcert::gum

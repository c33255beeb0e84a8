#include "gum/quantity/matrix_blocks.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace gumcert::gum {
namespace {

TEST(MatrixBlocks, AreThoseOfTheProgramOnEveryProcessor) {
    EXPECT_EQ(Eigen::l1CacheSize(), k_first_level_cache);
    EXPECT_EQ(Eigen::l2CacheSize(), k_second_level_cache);
    EXPECT_EQ(Eigen::l3CacheSize(), k_third_level_cache);
}

/// Products of matrices that are larger than a block, of several lengths of their sums: by some, blocks end elsewhere.
std::vector<Eigen::MatrixXd> products() {
    const auto entry = [](Eigen::Index i, Eigen::Index j) {
        return 1.0 / (1.0 + static_cast<double>((37 * i + 101 * j) % 997));
    };
    std::vector<Eigen::MatrixXd> all;
    for (const Eigen::Index length : {300, 400, 500, 600, 700, 900, 1200}) {
        const Eigen::MatrixXd a = Eigen::MatrixXd::NullaryExpr(70, length, entry);
        const Eigen::MatrixXd b = Eigen::MatrixXd::NullaryExpr(length, 60, entry);
        all.emplace_back(a * b);
    }
    return all;
}

// What this file is for. Should a later Eigen divide products by something else than the sizes of caches, this fails, and
// somebody has to look what it is.
TEST(MatrixBlocks, DecideTheLastBitsOfAProduct) {
    const std::vector<Eigen::MatrixXd> here = products();
    Eigen::setCpuCacheSizes(std::ptrdiff_t{32} << 10U, k_second_level_cache, k_third_level_cache);
    const std::vector<Eigen::MatrixXd> there = products();
    Eigen::setCpuCacheSizes(k_first_level_cache, k_second_level_cache, k_third_level_cache);
    EXPECT_NE(here, there);
    EXPECT_EQ(here, products());
    for (std::size_t i = 0; i < here.size(); ++i) {
        EXPECT_TRUE(here[i].isApprox(there[i], 1e-14));
    }
}

}  // namespace
}  // namespace gumcert::gum

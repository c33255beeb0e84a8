#include "archive/store/merkle.h"

#include <gtest/gtest.h>

#include "encoding/sha2.h"

namespace gumcert::archive {
namespace {

/// The leaves of the tests of certificate transparency.
std::vector<std::string> published_leaves() {
    std::vector<std::string> leaves = {"",
                                       std::string(1, '\0'),
                                       "\x10",
                                       "\x20\x21",
                                       "\x30\x31",
                                       "\x40\x41\x42\x43",
                                       "\x50\x51\x52\x53\x54\x55\x56\x57",
                                       ""};
    for (char byte = 0x60; byte < 0x70; ++byte) {
        leaves[7] += byte;
    }
    return leaves;
}

MerkleTree tree_of(std::size_t size) {
    MerkleTree tree;
    for (std::size_t i = 0; i < size; ++i) {
        tree.add("entry " + std::to_string(i));
    }
    return tree;
}

TEST(MerkleRoot, IsThePublishedOne) {
    MerkleTree tree;
    EXPECT_EQ(encoding::hexadecimal(tree.root()), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    for (const std::string& leaf : published_leaves()) {
        tree.add(leaf);
    }
    EXPECT_EQ(encoding::hexadecimal(tree.root(1)), "6e340b9cffb37a989ca544e6bb780a2c78901d3fb33738768511a30617afa01d");
    EXPECT_EQ(encoding::hexadecimal(tree.root()), "5dc9da79a70659a9ad559cb701ded9a2ab9d823aad2f4960cfe370eff4604328");
}

TEST(MerkleProof, LeadsFromEveryLeafOfEverySizeToItsRoot) {
    const MerkleTree tree = tree_of(35);
    for (std::size_t size = 1; size <= tree.size(); ++size) {
        for (std::size_t index = 0; index < size; ++index) {
            const std::vector<std::string> proof = tree.inclusion_proof(index, size);
            EXPECT_EQ(root_of_proof("entry " + std::to_string(index), index, size, proof), tree.root(size))
                << index << " of " << size;
        }
    }
}

TEST(MerkleProof, LeadsNowhereForAnythingElse) {
    const MerkleTree tree = tree_of(13);
    const std::vector<std::string> proof = tree.inclusion_proof(5, 13);
    EXPECT_NE(root_of_proof("entry 6", 5, 13, proof), tree.root());
    EXPECT_NE(root_of_proof("entry 5", 4, 13, proof), tree.root());
    EXPECT_NE(root_of_proof("entry 5", 5, 8, proof), tree.root());
    std::vector<std::string> other = proof;
    other[1][0] ^= 1;
    EXPECT_NE(root_of_proof("entry 5", 5, 13, other), tree.root());
    std::vector<std::string> shorter(proof.begin(), proof.end() - 1);
    EXPECT_EQ(root_of_proof("entry 5", 5, 13, shorter), std::nullopt);
    std::vector<std::string> longer = proof;
    longer.push_back(proof[0]);
    EXPECT_EQ(root_of_proof("entry 5", 5, 13, longer), std::nullopt);
    EXPECT_EQ(root_of_proof("entry 13", 13, 13, proof), std::nullopt);
}

/// A node is no leaf: without the prefixes a pair of hashes would pass for an entry.
TEST(MerkleRoot, DoesNotTakeANodeForALeaf) {
    MerkleTree tree = tree_of(2);
    MerkleTree forged;
    forged.add(encoding::sha256_bytes(std::string("\0entry 0", 8)) +
               encoding::sha256_bytes(std::string("\0entry 1", 8)));
    EXPECT_NE(forged.root(), tree.root());
}

TEST(ConsistencyProof, ShowsForEveryTwoSizesThatTheLaterTreeExtendsTheEarlierOne) {
    const MerkleTree tree = tree_of(64);
    for (std::size_t size = 1; size <= tree.size(); ++size) {
        for (std::size_t earlier = 1; earlier <= size; ++earlier) {
            std::vector<std::string> proof = tree.consistency_proof(earlier, size);
            EXPECT_TRUE(is_extended(earlier, tree.root(earlier), size, tree.root(size), proof))
                << earlier << " " << size;
            EXPECT_FALSE(is_extended(earlier, tree.root(1) + "x", size, tree.root(size), proof));
            if (earlier < size) {
                EXPECT_FALSE(is_extended(earlier, tree.root(earlier), size, tree.root(earlier), proof));
                EXPECT_FALSE(is_extended(size, tree.root(size), earlier, tree.root(earlier), proof));
            }
            for (std::string& node : proof) {
                node[5] = static_cast<char>(node[5] ^ 1);
                EXPECT_FALSE(is_extended(earlier, tree.root(earlier), size, tree.root(size), proof));
                node[5] = static_cast<char>(node[5] ^ 1);
            }
            proof.push_back(tree.root(1));
            EXPECT_FALSE(is_extended(earlier, tree.root(earlier), size, tree.root(size), proof)) << "too long";
            proof.pop_back();
            if (!proof.empty()) {
                proof.pop_back();
                EXPECT_FALSE(is_extended(earlier, tree.root(earlier), size, tree.root(size), proof)) << "too short";
            }
        }
    }
}

TEST(ConsistencyProof, DoesNotExistForATreeThatWasRewritten) {
    const MerkleTree tree = tree_of(40);
    for (std::size_t earlier = 1; earlier < 40; ++earlier) {
        MerkleTree other;
        for (std::size_t i = 0; i < 40; ++i) {
            other.add("entry " + std::to_string(i) + (i == earlier - 1 ? " rewritten" : ""));
        }
        EXPECT_FALSE(is_extended(earlier, tree.root(earlier), 40, other.root(), other.consistency_proof(earlier, 40)));
        EXPECT_FALSE(is_extended(earlier, tree.root(earlier), 40, other.root(), tree.consistency_proof(earlier, 40)));
    }
}

}  // namespace
}  // namespace gumcert::archive

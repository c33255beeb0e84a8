#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace gumcert::archive {

/// A Merkle tree with SHA-256 in the form of RFC 6962, 2.1: a leaf is hashed behind the byte 0x00, a node behind 0x01.
class MerkleTree {
public:
    /// \param entry  what the leaf stands for; here the hash of an entry of the log, 32 bytes
    void add(const std::string& entry);

    [[nodiscard]] std::size_t size() const { return rows_.empty() ? 0 : rows_.front().size(); }
    /// Root of the first leaves, 32 bytes; of none the SHA-256 of nothing. Takes as many hashes as the tree is high.
    /// \param size  at most size()
    [[nodiscard]] std::string root(std::size_t size) const;
    [[nodiscard]] std::string root() const { return root(size()); }
    /// What is needed beside a leaf to find the root of the first `size` leaves (RFC 6962, 2.1.1), the lowest first.
    /// \param index  from 0, below size
    [[nodiscard]] std::vector<std::string> inclusion_proof(std::size_t index, std::size_t size) const;
    /// What shows that the first `size` leaves begin with the first `earlier` ones (RFC 6962, 2.1.2).
    /// \param earlier  1 … size; of two equal sizes nothing is needed
    [[nodiscard]] std::vector<std::string> consistency_proof(std::size_t earlier, std::size_t size) const;

private:
    /// Hashes, 32 bytes each: of the leaves, of each two of them, of each four …
    std::vector<std::vector<std::string>> rows_;

    [[nodiscard]] std::string subtree(std::size_t first, std::size_t count) const;
};

/// The root that a leaf and its proof give (RFC 9162, 2.1.3.2).
/// \return none where the proof has another length than that of such a leaf
[[nodiscard]] std::optional<std::string> root_of_proof(const std::string& entry, std::size_t index, std::size_t size,
                                                       const std::vector<std::string>& proof);

/// Whether a proof shows that a tree of `size` leaves begins with one of `earlier` leaves (RFC 9162, 2.1.4.2).
[[nodiscard]] bool is_extended(std::size_t earlier, const std::string& earlier_root, std::size_t size,
                               const std::string& root, const std::vector<std::string>& proof);

}  // namespace gumcert::archive

#include "archive/store/merkle.h"

#include <bit>
#include <utility>

#include "encoding/sha2.h"

namespace gumcert::archive {

namespace {

std::string leaf_hash(const std::string& entry) {
    // With different bytes in front a node cannot be passed off as a leaf: without them the hash of two children,
    // presented as an entry, would have a valid proof.
    return encoding::sha256_bytes(std::string(1, '\0') + entry);
}

std::string node_hash(const std::string& left, const std::string& right) {
    return encoding::sha256_bytes('\x01' + left + right);
}

/// The largest power of two below n, which is at least 2.
std::size_t left_part(std::size_t n) {
    return std::bit_floor(n - 1);
}

/// Place of a node on its way from a leaf to the root, beside that of the last one of its row (RFC 9162, 2.1.3.2).
class WayToTheRoot {
public:
    WayToTheRoot(std::size_t node, std::size_t last) : node_(node), last_(last) {}

    [[nodiscard]] bool is_at_the_root() const { return last_ == 0; }
    [[nodiscard]] bool is_right_node() const { return node_ % 2 == 1; }
    /// Whether the next node of a proof stands left of it; else right.
    [[nodiscard]] bool joins_to_the_left() const { return is_right_node() || node_ == last_; }
    void up() {
        node_ /= 2;
        last_ /= 2;
    }
    /// To where it is joined with the next node of a proof. The last node of a row rises alone until it is a right one.
    void up_to_joint() {
        if (joins_to_the_left()) {
            while (!is_right_node() && node_ != 0) {
                up();
            }
        }
        up();
    }

private:
    std::size_t node_, last_;
};

}  // namespace

void MerkleTree::add(const std::string& entry) {
    std::string hash = leaf_hash(entry);
    for (std::size_t row = 0;; ++row) {
        if (row == rows_.size()) {
            rows_.emplace_back();
        }
        rows_[row].push_back(std::move(hash));
        const std::size_t count = rows_[row].size();
        // A node exists only above two complete halves: rows never change once they are written, so that the roots of
        // all earlier sizes can still be given.
        if (count % 2 == 1) {
            return;
        }
        hash = node_hash(rows_[row][count - 2], rows_[row][count - 1]);
    }
}

/// Root of `count` leaves from `first` on; the parts into which RFC 6962 divides a tree begin at multiples of their size.
std::string MerkleTree::subtree(std::size_t first, std::size_t count) const {
    if (std::has_single_bit(count)) {
        return rows_[static_cast<std::size_t>(std::countr_zero(count))][first / count];
    }
    const std::size_t left = left_part(count);
    return node_hash(subtree(first, left), subtree(first + left, count - left));
}

std::string MerkleTree::root(std::size_t size) const {
    return size == 0 ? encoding::sha256_bytes("") : subtree(0, size);
}

std::vector<std::string> MerkleTree::inclusion_proof(std::size_t index, std::size_t size) const {
    std::vector<std::string> from_the_top;
    std::size_t first = 0;
    while (size > 1) {
        const std::size_t left = left_part(size);
        if (index < left) {
            from_the_top.push_back(subtree(first + left, size - left));
            size = left;
        } else {
            from_the_top.push_back(subtree(first, left));
            first += left;
            index -= left;
            size -= left;
        }
    }
    return {from_the_top.rbegin(), from_the_top.rend()};
}

std::optional<std::string> root_of_proof(const std::string& entry, std::size_t index, std::size_t size,
                                         const std::vector<std::string>& proof) {
    if (index >= size) {
        return std::nullopt;
    }
    WayToTheRoot way(index, size - 1);
    std::string root = leaf_hash(entry);
    for (const std::string& beside : proof) {
        if (way.is_at_the_root()) {
            return std::nullopt;
        }
        root = way.joins_to_the_left() ? node_hash(beside, root) : node_hash(root, beside);
        way.up_to_joint();
    }
    // A proof that is too short ends below the root, and what it gives there is no root.
    return way.is_at_the_root() ? std::optional(root) : std::nullopt;
}

std::vector<std::string> MerkleTree::consistency_proof(std::size_t earlier, std::size_t size) const {
    std::vector<std::string> from_the_top;
    std::size_t first = 0;
    bool is_known = true;  // whether the part that is left is all of the earlier tree: its root is known then
    while (earlier < size) {
        const std::size_t left = left_part(size);
        if (earlier <= left) {
            from_the_top.push_back(subtree(first + left, size - left));
            size = left;
        } else {
            from_the_top.push_back(subtree(first, left));
            first += left;
            earlier -= left;
            size -= left;
            is_known = false;
        }
    }
    if (!is_known) {
        from_the_top.push_back(subtree(first, size));
    }
    return {from_the_top.rbegin(), from_the_top.rend()};
}

bool is_extended(std::size_t earlier, const std::string& earlier_root, std::size_t size, const std::string& root,
                 const std::vector<std::string>& proof) {
    if (earlier == 0 || earlier > size) {
        return false;
    }
    if (earlier == size) {
        return proof.empty() && earlier_root == root;
    }
    std::vector<std::string> path = proof;
    // An earlier tree of 2^n leaves is a whole part of the later one, and the proof leaves its root out.
    if (std::has_single_bit(earlier)) {
        path.insert(path.begin(), earlier_root);
    }
    if (path.empty()) {
        return false;
    }
    WayToTheRoot way(earlier - 1, size - 1);
    while (way.is_right_node()) {
        way.up();
    }
    std::string found_earlier = path.front();
    std::string found = path.front();
    for (std::size_t i = 1; i < path.size(); ++i) {
        if (way.is_at_the_root()) {
            return false;
        }
        if (way.joins_to_the_left()) {
            // What stands to the left belongs to both trees, what stands to the right to the later one only.
            found_earlier = node_hash(path[i], found_earlier);
            found = node_hash(path[i], found);
        } else {
            found = node_hash(found, path[i]);
        }
        way.up_to_joint();
    }
    return way.is_at_the_root() && found_earlier == earlier_root && found == root;
}

}  // namespace gumcert::archive

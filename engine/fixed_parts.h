#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>

namespace gumcert::engine {

/// Does task(0) … task(tasks - 1), some of them at a time, and returns when all are done, or throws what one of them
/// throws; empty: the calling thread does one after the other.
using Workers = std::function<void(std::size_t tasks, const std::function<void(std::size_t)>& task)>;

/// Parts of `count` things, whose size does not depend on the threads: sums that are made part by part, and added in
/// the order of the parts, have the same bytes for any number of threads.
class FixedParts {
public:
    FixedParts(std::size_t count, std::size_t size) : count_(count), size_(size) {}

    [[nodiscard]] std::size_t parts() const { return (count_ + size_ - 1) / size_; }

    /// work(part, begin, end) for every part.
    template <typename Work>
    void run(const Workers& workers, const Work& work) const {
        const auto one = [&](std::size_t part) { work(part, part * size_, std::min(count_, (part + 1) * size_)); };
        if (workers && parts() > 1) {
            workers(parts(), one);
            return;
        }
        for (std::size_t part = 0; part < parts(); ++part) {
            one(part);
        }
    }

private:
    std::size_t count_, size_;
};

}  // namespace gumcert::engine

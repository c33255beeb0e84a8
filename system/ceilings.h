#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>

namespace gumcert::system {

/// What this process may take; 0 is no ceiling.
struct Ceilings {
    std::uint64_t memory = 0;           ///< [byte] that are in memory at once, not what is reserved
    std::chrono::milliseconds time{0};  ///< from now on, whether it works or waits
};
enum class Ceiling { memory, time };

/// Bytes of this process that are in memory; 0 where the system does not say.
[[nodiscard]] std::uint64_t resident_memory();

/// Watches this process from now on, in a thread that ends with the process.
/// Behind it stands a wall of the system: twice the memory cannot be had, and std::bad_alloc says so.
/// \param end  called once, in that thread, when a ceiling is reached; does not return
void watch_ceilings(const Ceilings& ceilings, std::function<void(Ceiling)> end);

/// The same for some work: the watch, and the wall of the system, end with this. What is in memory when it begins does not
/// count.
class CeilingsOfWork {
public:
    /// \param end  as of watch_ceilings()
    CeilingsOfWork(Ceilings ceilings, std::function<void(Ceiling)> end);
    ~CeilingsOfWork();
    CeilingsOfWork(const CeilingsOfWork&) = delete;
    CeilingsOfWork& operator=(const CeilingsOfWork&) = delete;

private:
    struct Watch;
    std::unique_ptr<Watch> watch_;  ///< none where there is no ceiling
};

}  // namespace gumcert::system

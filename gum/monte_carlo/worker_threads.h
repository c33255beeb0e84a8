#pragma once

#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace gumcert::gum {

/// A few threads that share numbered tasks. The calling thread is one of them, so that one thread starts none.
///
/// Which thread takes which task is not determined: a task must write to its own place. Read in the order of the tasks,
/// the places give the same result for any number of threads.
class WorkerThreads {
public:
    /// \param count  1 … k_most; 0: as many as the machine has
    explicit WorkerThreads(unsigned count);
    ~WorkerThreads();
    WorkerThreads(const WorkerThreads&) = delete;
    WorkerThreads& operator=(const WorkerThreads&) = delete;

    static constexpr unsigned k_most = 256;

    [[nodiscard]] unsigned size() const { return static_cast<unsigned>(threads_.size()) + 1; }

    /// Does work(worker, task) for all tasks 0 … tasks - 1 and returns when all are done.
    /// \throws whatever the task with the lowest number throws that throws; the tasks before it are done, later ones
    /// may
    ///         be left out
    void run(std::size_t tasks, const std::function<void(unsigned worker, std::size_t task)>& work);

private:
    void wait_for_work(unsigned worker);
    void take_tasks(unsigned worker);

    std::vector<std::thread> threads_;
    std::mutex mutex_;
    std::condition_variable begin_;
    std::condition_variable end_;
    const std::function<void(unsigned, std::size_t)>* work_ = nullptr;
    std::size_t tasks_ = 0;
    std::size_t next_ = 0;
    std::size_t round_ = 0;
    unsigned busy_ = 0;
    bool stop_ = false;
    std::size_t failed_task_ = 0;
    std::exception_ptr failure_;
};

}  // namespace gumcert::gum

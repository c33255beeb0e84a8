#include "gum/monte_carlo/worker_threads.h"

#include <algorithm>
#include <system_error>
#include <utility>

namespace gumcert::gum {

WorkerThreads::WorkerThreads(unsigned count) {
    const unsigned wanted = std::clamp(count == 0 ? std::thread::hardware_concurrency() : count, 1U, k_most);
    threads_.reserve(wanted - 1);
    for (unsigned worker = 1; worker < wanted; ++worker) {
        try {
            threads_.emplace_back([this, worker] { wait_for_work(worker); });
        } catch (const std::system_error&) {
            break;  // the machine gives no more; those that there are do the same work
        }
    }
}

WorkerThreads::~WorkerThreads() {
    {
        const std::lock_guard lock(mutex_);
        stop_ = true;
    }
    begin_.notify_all();
    for (std::thread& thread : threads_) {
        thread.join();
    }
}

void WorkerThreads::run(std::size_t tasks, const std::function<void(unsigned worker, std::size_t task)>& work) {
    {
        const std::lock_guard lock(mutex_);
        work_ = &work;
        tasks_ = tasks;
        next_ = 0;
        failure_ = nullptr;
        failed_task_ = tasks;
        busy_ = static_cast<unsigned>(threads_.size());
        ++round_;
    }
    begin_.notify_all();
    // The calling thread works, too: with one thread nothing is started.
    take_tasks(0);
    std::unique_lock lock(mutex_);
    end_.wait(lock, [this] { return busy_ == 0; });
    work_ = nullptr;
    if (failure_) {
        std::rethrow_exception(std::exchange(failure_, nullptr));
    }
}

void WorkerThreads::wait_for_work(unsigned worker) {
    std::size_t seen = 0;
    for (;;) {
        {
            std::unique_lock lock(mutex_);
            // The number of the round and not a flag: a thread that is late must not take part in a round twice.
            begin_.wait(lock, [&] { return stop_ || round_ != seen; });
            if (stop_) {
                return;
            }
            seen = round_;
        }
        take_tasks(worker);
        {
            const std::lock_guard lock(mutex_);
            --busy_;
        }
        end_.notify_one();
    }
}

void WorkerThreads::take_tasks(unsigned worker) {
    for (;;) {
        std::size_t task = 0;
        {
            const std::lock_guard lock(mutex_);
            // Tasks before the one that failed are still done: one of them may fail as well, and the lowest one is
            // reported.
            if (next_ >= tasks_ || next_ > failed_task_) {
                return;
            }
            task = next_++;
        }
        try {
            (*work_)(worker, task);
        } catch (...) {
            const std::lock_guard lock(mutex_);
            // Of several failures that of the first task is kept, whichever thread was sooner: the message is the same
            // for any number of threads.
            if (task < failed_task_) {
                failed_task_ = task;
                failure_ = std::current_exception();
            }
        }
    }
}

}  // namespace gumcert::gum

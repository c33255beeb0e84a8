// Largest memory of one Monte Carlo run of the gauge block of JCGM 101:2008, 9.5:
//
//   monte_carlo_memory TRIALS THREADS
//
// prints JSON. One run a process, because the system keeps the largest memory of a process and no more.
#include <sys/resource.h>

#include <charconv>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <string_view>

#include "bench/gauge_block.h"

namespace {

template <class Number>
bool read(std::string_view text, Number& number) {
    const std::from_chars_result result = std::from_chars(text.data(), text.data() + text.size(), number);
    return result.ec == std::errc() && result.ptr == text.data() + text.size();
}

}  // namespace

int main(int argc, char** argv) {
    namespace gum = gumcert::gum;
    gum::MonteCarloOptions options = gum::gauge_block_options();
    if (argc != 3 || !read(argv[1], options.trials) || !read(argv[2], options.threads)) {
        std::cerr << "usage: monte_carlo_memory TRIALS THREADS\n";
        return 2;
    }
    const gum::EquationModel model = gum::gauge_block();
    const auto begin = std::chrono::steady_clock::now();
    const gum::MonteCarloResult result = gum::run_monte_carlo(model, options);
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin;
    rusage usage{};
    if (getrusage(RUSAGE_SELF, &usage) != 0) {
        std::cerr << "monte_carlo_memory: the system does not tell the memory\n";
        return EXIT_FAILURE;
    }
    std::cout.precision(10);
    std::cout << "{\"trials\": " << result.trials << ", \"threads\": " << options.threads
              << ", \"wall_s\": " << wall.count() << ", \"peak_kib\": " << usage.ru_maxrss
              << ", \"u\": " << result.outputs[0].standard_uncertainty << "}\n";
    return EXIT_SUCCESS;
}

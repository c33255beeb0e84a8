// A program of somebody else that uses the installed package: coverage factors of JCGM 100:2008, table G.2, p = 95.45
// %.
#include "gum/coverage.h"

#include <cstdio>
#include <initializer_list>
#include <limits>

int main() {
    for (const double degrees_of_freedom : {1.0, 5.0, 10.0, 50.0, std::numeric_limits<double>::infinity()}) {
        std::printf("%g %.2f\n", degrees_of_freedom, gumcert::gum::coverage_factor(0.9545, degrees_of_freedom));
    }
    return 0;
}

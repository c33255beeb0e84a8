// Calibration of a mass standard in air by Monte Carlo (JCGM 101:2008, 9.3), with a measurement model of one's own.
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "gum/monte_carlo/monte_carlo.h"
#include "gum/propagation.h"
#include "gum/quantity/diagnostic.h"

using namespace gumcert::gum;

namespace {

// dm = (m_Rc + dm_Rc)(1 + (rho_a − 1.2 kg/m³)(1/rho_W − 1/rho_R)) − 100 g
class MassInAir final : public MeasurementModel {
public:
    MassInAir() {
        add("m_Rc", "kg", Distribution::normal(0.1, 50e-9));
        add("dm_Rc", "kg", Distribution::normal(1.234e-6, 20e-9));
        add("rho_a", "kg m-3", Distribution::uniform(1.20, 0.10));
        add("rho_W", "kg m-3", Distribution::uniform(8000.0, 1000.0));
        add("rho_R", "kg m-3", Distribution::uniform(8000.0, 50.0));
    }

    [[nodiscard]] const std::vector<InputGroup>& inputs() const override { return groups_; }
    [[nodiscard]] const std::vector<OutputQuantity>& outputs() const override { return outputs_; }
    [[nodiscard]] Eigen::VectorXd evaluate(const Eigen::VectorXd& x) const override {
        return Eigen::VectorXd::Constant(1, (x[0] + x[1]) * (1.0 + (x[2] - 1.2) * (1.0 / x[3] - 1.0 / x[4])) - 0.1);
    }
    [[nodiscard]] Eigen::MatrixXd jacobian(const Eigen::VectorXd& x) const override {
        const double mass = x[0] + x[1];
        const double volumes = 1.0 / x[3] - 1.0 / x[4];
        const double air = x[2] - 1.2;  // 0 at the estimates: the first-order terms of both densities vanish
        Eigen::MatrixXd c(1, 5);
        c << 1.0 + air * volumes, 1.0 + air * volumes, mass * volumes, -mass * air / (x[3] * x[3]),
            mass * air / (x[4] * x[4]);
        return c;
    }

private:
    /// One declaration serves both methods: the moments for the law of propagation, the distribution for Monte Carlo.
    void add(const char* name, const char* unit, Distribution distribution) {
        InputGroup group;
        group.name = name;
        group.unit = unit;
        const double u = standard_deviation(distribution);
        group.value = Eigen::VectorXd::Constant(1, expectation(distribution));
        group.covariance = Eigen::MatrixXd::Constant(1, 1, u * u);
        group.marginals = {std::move(distribution)};
        groups_.push_back(std::move(group));
    }

    std::vector<InputGroup> groups_;
    std::vector<OutputQuantity> outputs_{{.name = "dm", .unit = "kg"}};
};

}  // namespace

int main() try {
    const MassInAir model;
    const double mg = 1e-6;  // kg
    const Propagation law = propagate(model, 0.95);
    MonteCarloOptions options;
    options.coverage_probability = 0.95;
    options.seed = 1;  // the same seed gives the same digits, for any number of threads
    const MonteCarloOutput trials = run_monte_carlo(model, options).outputs[0];
    std::printf("law of propagation  dm = %.4f mg, u = %.4f mg\n", law.value[0] / mg, law.standard_uncertainty[0] / mg);
    std::printf("Monte Carlo         dm = %.4f mg, u = %.4f mg (+- %.4f mg), 95 %% from %.2f mg to %.2f mg\n",
                trials.mean / mg, trials.standard_uncertainty / mg, trials.numerical_error.standard_uncertainty / mg,
                trials.shortest.low / mg, trials.shortest.high / mg);
    // Clause 8: do both intervals agree in the digits of u that are meant?
    const Validation check = validate(law.value[0], law.standard_uncertainty[0], law.expanded_uncertainty[0],
                                      trials.shortest, trials.numerical_error.shortest, 1);
    std::printf("the law of propagation is %svalidated\n", check.validated ? "" : "not ");
    return 0;
} catch (const DiagnosedError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}

// A calibration line through points that are uncertain in both variables (the data of ISO/TS 28037:2010, clause 7), and
// a value that is read from it.
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "engine/curve_fit.h"
#include "gum/expression/equation_model.h"
#include "gum/propagation.h"
#include "gum/quantity/diagnostic.h"

using namespace gumcert;

namespace {

/// y = a + b x. Any curve will do, with start values where it is not linear in its parameters.
class Line final : public engine::Curve {
public:
    double evaluate(const Eigen::VectorXd& x, const Eigen::VectorXd& parameters, Eigen::VectorXd& by_parameter,
                    Eigen::VectorXd& by_x) const override {
        by_parameter << 1.0, x[0];
        by_x[0] = parameters[1];
        return parameters[0] + parameters[1] * x[0];
    }
    [[nodiscard]] bool is_linear() const override { return true; }
};

gum::InputGroup group(const char* name, const Eigen::VectorXd& value, const Eigen::MatrixXd& covariance) {
    gum::InputGroup result;
    result.name = name;
    result.unit = "1";
    result.value = value;
    result.covariance = covariance;
    return result;
}

}  // namespace

int main() try {
    engine::CurveData data;
    data.x = (Eigen::VectorXd(6) << 1.2, 1.9, 2.9, 4.0, 4.7, 5.9).finished();
    data.y = (Eigen::VectorXd(6) << 3.4, 4.4, 7.2, 8.5, 10.8, 13.5).finished();
    data.x_uncertainty = Eigen::VectorXd::Constant(6, 0.2);
    data.y_uncertainty = (Eigen::VectorXd(6) << 0.2, 0.2, 0.2, 0.4, 0.4, 0.4).finished();

    // Errors in both variables are found by a search; the line by eye is a good place to begin.
    const Eigen::VectorXd start = (Eigen::VectorXd(2) << 0.0, 2.0).finished();
    const engine::CurveFit fit = engine::fit_curve(Line{}, data, start, {"a", "b"});
    std::printf("a = %.4f, u = %.4f\n", fit.parameters[0], std::sqrt(fit.covariance(0, 0)));
    std::printf("b = %.4f, u = %.4f\n", fit.parameters[1], std::sqrt(fit.covariance(1, 1)));
    std::printf("chi-square = %.3f on %.0f degrees of freedom\n", fit.sum_of_squares, fit.degrees_of_freedom);

    // Which x belongs to an indication of 10.5? The parameters are one group: without their covariance u would be
    // more than twice as large.
    const std::vector<gum::EquationText> equations{{.text = "x = (y - a)/b", .where = "prediction"}};
    const std::vector<gum::InputSymbol> symbols{{.name = "a", .unit = {}, .constant = {}},
                                                {.name = "b", .unit = {}, .constant = {}},
                                                {.name = "y", .unit = {}, .constant = {}}};
    const gum::EquationModel model(
        gum::EquationSystem::compile(equations, symbols),
        {group("line", fit.parameters, fit.covariance),
         group("indication", Eigen::VectorXd::Constant(1, 10.5), Eigen::MatrixXd::Constant(1, 1, 0.2 * 0.2))});
    const gum::Propagation prediction = gum::propagate(model, 0.95);
    std::printf("x = %.3f, u = %.3f; the line gives %.0f %% of the variance\n", prediction.value[0],
                prediction.standard_uncertainty[0], 100.0 * prediction.budget[0].share[0]);
    return 0;
} catch (const gum::DiagnosedError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}

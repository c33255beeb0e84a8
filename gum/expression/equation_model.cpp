#include "gum/expression/equation_model.h"

#include <string>
#include <utility>

#include "gum/quantity/diagnostic.h"
#include "text/counts.h"

namespace gumcert::gum {

EquationModel::EquationModel(EquationSystem system, std::vector<InputGroup> groups)
    : system_(std::move(system)), groups_(std::move(groups)) {
    std::size_t size = 0;
    for (const InputGroup& group : groups_) {
        size += static_cast<std::size_t>(group.size());
    }
    if (size != system_.input_count()) {
        throw InputError(
            Diagnostic{.code = "GC-MODEL-0070",
                       .where = "inputs",
                       .what = text::count_of(size, "value"),
                       .rule = "the number of inputs of the equations is " + std::to_string(system_.input_count()),
                       .action = "Give one value for every input."});
    }
    for (std::size_t i = 0; i < system_.output_count(); ++i) {
        const Unit& unit = system_.output_unit(i);
        outputs_.push_back({.name = system_.output_name(i),
                            .unit = Unit::coherent(unit.dimension(), unit.is_celsius_temperature()).text()});
    }
    if (system_.unknown_count() != 0) {
        try {
            start_ = system_.solve(input_estimates(*this));
        } catch (const NoResultError&) {
            start_.resize(0);  // evaluate() says what is wrong; trials search from the declared start values
        }
    }
}

Eigen::VectorXd EquationModel::evaluate(const Eigen::VectorXd& x) const {
    return system_.evaluate(x);
}

Eigen::MatrixXd EquationModel::jacobian(const Eigen::VectorXd& x) const {
    return system_.jacobian(x);
}

std::vector<Eigen::MatrixXd> EquationModel::hessians(const Eigen::VectorXd& x) const {
    return system_.hessians(x);
}

void EquationModel::evaluate_trials(const Eigen::Ref<const Eigen::MatrixXd>& x, Eigen::Ref<Eigen::MatrixXd> y) const {
    system_.evaluate_trials(x, y, start_);
}

}  // namespace gumcert::gum

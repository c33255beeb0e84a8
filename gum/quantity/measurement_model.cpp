#include "gum/quantity/measurement_model.h"

namespace gumcert::gum {

InputQuantity InputGroup::quantity(Eigen::Index i) const {
    if (!quantities.empty()) {
        return quantities[static_cast<std::size_t>(i)];
    }
    return {size() > 1 ? name + "[" + std::to_string(i + 1) + "]" : name, unit};
}

std::vector<Eigen::MatrixXd> MeasurementModel::hessians(const Eigen::VectorXd& /*x*/) const {
    return {};
}

void MeasurementModel::evaluate_trials(const Eigen::Ref<const Eigen::MatrixXd>& x,
                                       Eigen::Ref<Eigen::MatrixXd> y) const {
    for (Eigen::Index trial = 0; trial < x.rows(); ++trial) {
        y.row(trial) = evaluate(x.row(trial).transpose()).transpose();
    }
}

Eigen::VectorXd input_estimates(const MeasurementModel& model) {
    Eigen::Index size = 0;
    for (const InputGroup& group : model.inputs()) {
        size += group.size();
    }
    Eigen::VectorXd x(size);
    Eigen::Index first = 0;
    for (const InputGroup& group : model.inputs()) {
        x.segment(first, group.size()) = group.value;
        first += group.size();
    }
    return x;
}

}  // namespace gumcert::gum

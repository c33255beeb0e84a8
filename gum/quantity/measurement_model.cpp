#include "gum/quantity/measurement_model.h"

namespace gumcert::gum {

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

#include "reports/studies/plan_figures.h"

#include "gum/rotary_table/studies/plan_texts.h"
#include "reports/plots/layout_plot.h"
#include "reports/plots/svg_plot.h"

namespace gumcert::reports::plan {

using gum::plan::Expected;
using gum::plan::Motion;
using gum::plan::plain;
using gum::plan::Proposal;
using gum::plan::Setting;
using gum::plan::U_text;
using gum::plan::unit_of_motion;

namespace {

using engine::RotaryTableMeasurement;

std::array<double, 3> millimetres(const Eigen::Vector3d& position) {
    return {position[0] / gum::k_mm.si, position[1] / gum::k_mm.si, position[2] / gum::k_mm.si};
}

std::array<std::array<double, 3>, 3> square_millimetres(const Eigen::Matrix3d& covariance) {
    std::array<std::array<double, 3>, 3> result{};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            result[i][j] =
                covariance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) / (gum::k_mm.si * gum::k_mm.si);
        }
    }
    return result;
}

}  // namespace

std::string axis_letter(const RotaryTableMeasurement& layout) {
    return std::string(1, "ABC"[engine::axial_coordinate(layout.axis)]);
}

reports::StudyFigure layout_figure(const Setting& setting, const Expected& now,
                                   const std::optional<Proposal>& proposal) {
    const RotaryTableMeasurement& layout = setting.layout;
    reports::LayoutPlot plot;
    plot.id = "plot-plan-layout";
    plot.title = "Planned layout";
    plot.description = "Stations and reflectors in three views";
    plot.axis = axis_letter(layout);
    plot.stations_label = "station, planned";
    plot.marked_label = "station, proposed";
    for (std::size_t j = 0; j < layout.stations.size(); ++j) {
        plot.stations.push_back({.name = layout.stations[j],
                                 .position_mm = millimetres(*layout.station_start[j]),
                                 .covariance_mm2 = square_millimetres(now.uncertainty.stations[j].covariance)});
    }
    for (std::size_t j = 0; proposal && j < layout.stations.size(); ++j) {
        if (proposal->stations.positions[j] != *layout.station_start[j]) {
            plot.stations.push_back({.name = layout.stations[j],
                                     .position_mm = millimetres(proposal->stations.positions[j]),
                                     .marked = true});
        }
    }
    for (std::size_t m = 0; m < layout.reflectors.size(); ++m) {
        const auto at = static_cast<Eigen::Index>(m);
        plot.reflectors.push_back(
            {.name = layout.reflectors[m],
             .position_mm = millimetres(layout.fixture.row(at).transpose()),
             .covariance_mm2 = square_millimetres(layout.fixture_covariance.block<3, 3>(3 * at, 3 * at))});
    }
    const reports::LayoutMagnification magnified = reports::layout_magnification(plot);
    std::string caption = "Stations and reflectors at the home angle in the frame of the table";
    if (magnified.stations > 0.0) {
        caption +=
            "; confidence ellipses (95 %) of the planned stations magnified " + plain(magnified.stations) + " times";
    }
    if (magnified.reflectors > 0.0) {
        caption += ", of the reflectors " + plain(magnified.reflectors) + " times";
    }
    return {caption + ".", "Three views of the layout; the positions are in the tables.", reports::svg(plot)};
}

reports::StudyFigure bars_figure(const Setting& setting, const Expected& now, const std::optional<Proposal>& proposal) {
    reports::BarPlot plot{.id = "plot-plan-uncertainty",
                          .title = "Largest expected U of each error motion",
                          .description = "Bars in per cent of the target",
                          .x_label = "largest U in % of its target",
                          .bars = {}};
    for (std::size_t c = 0; c < 6; ++c) {
        const gum::DocumentUnit& unit = unit_of_motion(c);
        const auto add = [&](const std::string& label, const Motion& motion) {
            const std::string gap = c < 3 ? " " : "";
            plot.bars.push_back({label, 100.0 * motion.largest / target_of(setting, c),
                                 U_text(motion.largest, unit) + gap + unit.print});
        };
        add(setting.names[c] + (proposal ? ", planned" : ""), now.motions[c]);
        if (proposal) {
            add(setting.names[c] + ", proposed", proposal->expected.motions[c]);
        }
    }
    return {std::string("Largest expected U of each error motion") +
                (proposal ? ", planned and with the proposed stations." : "."),
            "Bars; the numbers are in the tables.", reports::svg(plot)};
}

}  // namespace gumcert::reports::plan

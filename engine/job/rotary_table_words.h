#pragma once

#include "engine/job/job_fields.h"
#include "engine/machine_frame.h"
#include "engine/rotary_table_measurement.h"

namespace gumcert::engine {

// The words for the choices of a rotary_table job, which records repeat.

inline constexpr Words<RotaryAxis, 3> k_axes{{{"A", RotaryAxis::a}, {"B", RotaryAxis::b}, {"C", RotaryAxis::c}}};
inline constexpr Words<Datum, 2> k_datums{{{"axis_average_line", Datum::axis_average_line}, {"home", Datum::home}}};
inline constexpr Words<AdjustmentMethod, 2> k_methods{
    {{"joint", AdjustmentMethod::joint}, {"sequential", AdjustmentMethod::sequential}}};
inline constexpr Words<ReversalModel, 3> k_reversals{
    {{"auto", ReversalModel::automatic}, {"constant", ReversalModel::constant}, {"by_angle", ReversalModel::by_angle}}};
inline constexpr Words<ScaleModel, 3> k_scale_models{
    {{"fixed", ScaleModel::fixed}, {"prior", ScaleModel::prior}, {"free", ScaleModel::free}}};
inline constexpr Words<RepeatabilityMode, 3> k_repeatability_modes{{{"estimate", RepeatabilityMode::estimate},
                                                                    {"given", RepeatabilityMode::given},
                                                                    {"none", RepeatabilityMode::none}}};
inline constexpr Words<bool, 2> k_length_noises{{{"estimate", true}, {"fixed", false}}};
inline constexpr Words<OutlierTest, 2> k_outlier_tests{
    {{"data_snooping", OutlierTest::data_snooping}, {"none", OutlierTest::none}}};
inline constexpr Words<OutlierAction, 2> k_outlier_actions{
    {{"report", OutlierAction::report}, {"remove", OutlierAction::remove}}};
inline constexpr Words<InputShape, 2> k_shapes{{{"normal", InputShape::normal}, {"uniform", InputShape::uniform}}};
inline constexpr Words<FixtureComponent, 3> k_fixture_components{
    {{"check", FixtureComponent::check}, {"estimate", FixtureComponent::estimate}, {"given", FixtureComponent::given}}};
/// Whether the uncertainty of the fixture is that of the source paper.
inline constexpr Words<bool, 2> k_fixture_uncertainties{{{"stated", false}, {"source_paper", true}}};
inline constexpr Words<MachineFramePoints, 2> k_machine_points{
    {{"probing", MachineFramePoints::reflectors}, {"stations", MachineFramePoints::stations}}};

}  // namespace gumcert::engine

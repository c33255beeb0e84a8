#pragma once

#include "engine/rotary_table/machine_frame.h"
#include "engine/rotary_table/rotary_table_measurement.h"
#include "jobs/job_fields.h"

namespace gumcert::jobs {

// The words for the choices of a rotary_table job, which records repeat.

inline constexpr Words<engine::RotaryAxis, 3> k_axes{
    {{"A", engine::RotaryAxis::a}, {"B", engine::RotaryAxis::b}, {"C", engine::RotaryAxis::c}}};
inline constexpr Words<engine::Datum, 2> k_datums{
    {{"axis_average_line", engine::Datum::axis_average_line}, {"home", engine::Datum::home}}};
inline constexpr Words<engine::AdjustmentMethod, 2> k_methods{
    {{"joint", engine::AdjustmentMethod::joint}, {"sequential", engine::AdjustmentMethod::sequential}}};
inline constexpr Words<engine::ReversalModel, 3> k_reversals{{{"auto", engine::ReversalModel::automatic},
                                                              {"constant", engine::ReversalModel::constant},
                                                              {"by_angle", engine::ReversalModel::by_angle}}};
inline constexpr Words<engine::ScaleModel, 3> k_scale_models{
    {{"fixed", engine::ScaleModel::fixed}, {"prior", engine::ScaleModel::prior}, {"free", engine::ScaleModel::free}}};
inline constexpr Words<engine::RepeatabilityMode, 3> k_repeatability_modes{
    {{"estimate", engine::RepeatabilityMode::estimate},
     {"given", engine::RepeatabilityMode::given},
     {"none", engine::RepeatabilityMode::none}}};
inline constexpr Words<bool, 2> k_length_noises{{{"estimate", true}, {"fixed", false}}};
inline constexpr Words<engine::OutlierTest, 2> k_outlier_tests{
    {{"data_snooping", engine::OutlierTest::data_snooping}, {"none", engine::OutlierTest::none}}};
inline constexpr Words<engine::OutlierAction, 2> k_outlier_actions{
    {{"report", engine::OutlierAction::report}, {"remove", engine::OutlierAction::remove}}};
inline constexpr Words<engine::InputShape, 2> k_shapes{
    {{"normal", engine::InputShape::normal}, {"uniform", engine::InputShape::uniform}}};
inline constexpr Words<engine::FixtureComponent, 3> k_fixture_components{
    {{"check", engine::FixtureComponent::check},
     {"estimate", engine::FixtureComponent::estimate},
     {"given", engine::FixtureComponent::given}}};
/// Whether the uncertainty of the fixture is that of the source paper.
inline constexpr Words<bool, 2> k_fixture_uncertainties{{{"stated", false}, {"source_paper", true}}};
inline constexpr Words<engine::MachineFramePoints, 2> k_machine_points{
    {{"probing", engine::MachineFramePoints::reflectors}, {"stations", engine::MachineFramePoints::stations}}};

}  // namespace gumcert::jobs

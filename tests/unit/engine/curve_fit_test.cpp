// Least-squares fits against certified and printed results, and what is refused.
#include "engine/curve_fit.h"

#include <ceres/jet.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

#include "gum/quantity/diagnostic.h"
#include "tests/support/reference_case.h"

namespace gumcert::engine {
namespace {

using gumcert::test::expected_number;
using gumcert::test::reference_case;
using gumcert::test::reference_ids;
using nlohmann::json;
using Number = ceres::Jet<double, 9>;
using Numbers = std::vector<Number>;
using Formula = std::function<Number(const Numbers& b, const Numbers& x)>;

/// A curve from its formula, derivatives by dual numbers.
class FormulaCurve final : public Curve {
public:
    explicit FormulaCurve(Formula formula) : formula_(std::move(formula)) {}

    double evaluate(const Eigen::VectorXd& x, const Eigen::VectorXd& parameters, Eigen::VectorXd& by_parameter,
                    Eigen::VectorXd& by_x) const override {
        Numbers b;
        Numbers regressors;
        int index = 0;
        for (const double value : parameters) {
            b.emplace_back(value, index++);
        }
        for (const double value : x) {
            regressors.emplace_back(value, index++);
        }
        const Number value = formula_(b, regressors);
        by_parameter = value.v.head(parameters.size());
        by_x = value.v.segment(parameters.size(), x.size());
        return value.a;
    }
    [[nodiscard]] bool is_linear() const override { return false; }

private:
    Formula formula_;
};

/// b0 + b1 x + b2 x² + … up to the degree given, without b0 for a curve through the origin.
class Polynomial final : public Curve {
public:
    explicit Polynomial(int degree, bool through_origin = false) : degree_(degree), first_(through_origin ? 1 : 0) {}

    double evaluate(const Eigen::VectorXd& x, const Eigen::VectorXd& parameters, Eigen::VectorXd& by_parameter,
                    Eigen::VectorXd& by_x) const override {
        long double value = 0.0L;
        long double slope = 0.0L;
        for (int power = first_; power <= degree_; ++power) {
            const long double term = std::pow(static_cast<long double>(x[0]), power);
            by_parameter[power - first_] = static_cast<double>(term);
            value += term * static_cast<long double>(parameters[power - first_]);
            if (power > 0) {
                slope += static_cast<long double>(power * parameters[power - first_]) *
                         std::pow(static_cast<long double>(x[0]), power - 1);
            }
        }
        by_x[0] = static_cast<double>(slope);
        return static_cast<double>(value);
    }
    [[nodiscard]] bool is_linear() const override { return true; }

private:
    int degree_;
    int first_;
};

/// b0 + b1 x1 + … + bq xq
class Plane final : public Curve {
public:
    double evaluate(const Eigen::VectorXd& x, const Eigen::VectorXd& parameters, Eigen::VectorXd& by_parameter,
                    Eigen::VectorXd& by_x) const override {
        by_parameter << 1.0, x;
        by_x = parameters.tail(x.size());
        return parameters.dot(by_parameter);
    }
    [[nodiscard]] bool is_linear() const override { return true; }
};

const Polynomial k_line(1);

std::vector<std::string> names_of(std::size_t count) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < count; ++i) {
        names.push_back("b" + std::to_string(i + 1));
    }
    return names;
}

Eigen::VectorXd vector(const std::vector<double>& values) {
    return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

CurveData points(const std::vector<double>& x, const std::vector<double>& y) {
    CurveData data;
    data.x = vector(x);
    data.y = vector(y);
    return data;
}

CurveFit fit_line(const CurveData& data) {
    return fit_curve(k_line, data, {}, {"a", "b"});
}

/// Number of correct digits (log relative error), not more than were certified; the file texts hold 11 or 15.
double correct_digits(double value, const std::string& certified, double most) {
    double expected = 0.0;
    const char* begin = certified.data() + (certified.front() == '+' ? 1 : 0);
    EXPECT_EQ(std::from_chars(begin, certified.data() + certified.size(), expected).ec, std::errc()) << certified;
    const double error = expected == 0.0 ? std::abs(value) : std::abs(value - expected) / std::abs(expected);
    return error == 0.0 ? most : std::min(most, -std::log10(error));
}

/// Half a unit of the last digit of a printed number.
double half_unit(const std::string& text) {
    const std::size_t e = text.find_first_of("eE");
    const std::string mantissa = text.substr(0, e);
    int exponent = e == std::string::npos ? 0 : std::stoi(text.substr(e + 1));
    const std::size_t point = mantissa.find('.');
    exponent -= point == std::string::npos ? 0 : static_cast<int>(mantissa.size() - point) - 1;
    return 0.5 * std::pow(10.0, exponent);
}

double correlation(const CurveFit& fit) {
    return fit.covariance(0, 1) / std::sqrt(fit.covariance(0, 0) * fit.covariance(1, 1));
}

/// Significant digits of a printed number; of a zero as many as any set certifies.
double significant_digits(const std::string& text) {
    std::string digits = text.substr(0, text.find_first_of("eE"));
    std::erase_if(digits, [](char c) { return c < '0' || c > '9'; });
    digits.erase(0, digits.find_first_not_of('0'));
    return digits.empty() ? 15.0 : static_cast<double>(digits.size());
}

CurveData data_of(const json& reference) {
    CurveData data;
    data.y = vector(reference["data"]["y"].get<std::vector<double>>());
    std::vector<std::string> columns{"x"};
    if (!reference["data"].contains("x")) {
        columns.clear();
        for (int k = 1; reference["data"].contains("x" + std::to_string(k)); ++k) {
            columns.push_back("x" + std::to_string(k));
        }
    }
    data.x.resize(data.y.size(), static_cast<Eigen::Index>(columns.size()));
    for (std::size_t k = 0; k < columns.size(); ++k) {
        data.x.col(static_cast<Eigen::Index>(k)) = vector(reference["data"][columns[k]].get<std::vector<double>>());
    }
    for (const auto& [key, member] :
         std::map<std::string, Eigen::MatrixXd*>{{"u_y", &data.y_uncertainty}, {"u_x", &data.x_uncertainty}}) {
        if (reference["data"].contains(key)) {
            *member = vector(reference["data"][key].get<std::vector<double>>());
        }
    }
    return data;
}

/// Fewest correct digits of everything that a NIST file certifies; parameters, standard deviations and sums apart.
struct Digits {
    double parameters = 99.0;
    double standard_deviations = 99.0;
    double sums = 99.0;
};

Digits digits_of(const CurveFit& fit, const json& reference) {
    Digits digits;
    Eigen::Index parameter = 0;
    Eigen::Index deviation = 0;
    for (const json& expected : reference["expected"]) {
        const std::string kind = expected["kind"];
        const std::string text = expected["printed"];
        const auto keep = [&](double& least, double value) {
            const double digits_here = correct_digits(value, text, significant_digits(text));
            least = std::min(least, digits_here);
        };
        if (kind == "parameter") {
            keep(digits.parameters, fit.parameters[parameter++]);
        } else if (kind == "u") {
            keep(digits.standard_deviations, std::sqrt(fit.covariance(deviation, deviation)));
            ++deviation;
        } else if (kind == "residual_std") {
            keep(digits.sums, fit.residual_standard_deviation);
        } else if (kind == "residual_sum_of_squares" ||
                   (kind == "sum_of_squares" && expected["quantity"] == "residual")) {
            keep(digits.sums, fit.sum_of_squares);
        } else if (kind == "r_squared") {
            keep(digits.sums, fit.r_squared.value());
        } else if (kind == "dof") {
            EXPECT_EQ(fit.degrees_of_freedom, expected_number(expected));
        }
    }
    EXPECT_EQ(parameter, fit.parameters.size());
    EXPECT_EQ(deviation, fit.parameters.size());
    return digits;
}

std::string text_of(const Digits& digits) {
    return "parameters " + std::to_string(digits.parameters) + ", standard deviations " +
           std::to_string(digits.standard_deviations) + ", sums " + std::to_string(digits.sums);
}

Number rational(const Numbers& b, const Number& x) {
    return (b[0] + b[1] * x + b[2] * x * x + b[3] * x * x * x) / (1.0 + b[4] * x + b[5] * x * x + b[6] * x * x * x);
}

Number three_exponentials(const Numbers& b, const Numbers& x) {
    return b[0] * exp(-b[1] * x[0]) + b[2] * exp(-b[3] * x[0]) + b[4] * exp(-b[5] * x[0]);
}

/// Formulas of the NIST StRD nonlinear sets, as printed in the files.
const std::map<std::string, Formula> k_strd_formulas{
    {"boxbod", [](const Numbers& b, const Numbers& x) { return b[0] * (1.0 - exp(-b[1] * x[0])); }},
    {"chwirut2", [](const Numbers& b, const Numbers& x) { return exp(-b[0] * x[0]) / (b[1] + b[2] * x[0]); }},
    {"danwood", [](const Numbers& b, const Numbers& x) { return b[0] * pow(x[0], b[1]); }},
    {"eckerle4",
     [](const Numbers& b, const Numbers& x) {
         const Number z = (x[0] - b[2]) / b[1];
         return b[0] / b[1] * exp(-0.5 * z * z);
     }},
    {"hahn1", [](const Numbers& b, const Numbers& x) { return rational(b, x[0]); }},
    {"lanczos3", three_exponentials},
    {"mgh09", [](const Numbers& b,
                 const Numbers& x) { return b[0] * (x[0] * x[0] + x[0] * b[1]) / (x[0] * x[0] + x[0] * b[2] + b[3]); }},
    {"misra1a", [](const Numbers& b, const Numbers& x) { return b[0] * (1.0 - exp(-b[1] * x[0])); }},
    {"misra1d", [](const Numbers& b, const Numbers& x) { return b[0] * b[1] * x[0] / (1.0 + b[1] * x[0]); }},
    {"nelson", [](const Numbers& b, const Numbers& x) { return b[0] - b[1] * x[0] * exp(-b[2] * x[1]); }},
    {"rat43", [](const Numbers& b, const Numbers& x) { return b[0] / pow(1.0 + exp(b[1] - b[2] * x[0]), 1.0 / b[3]); }},
    {"roszman1", [](const Numbers& b,
                    const Numbers& x) { return b[0] - b[1] * x[0] - atan(b[2] / (x[0] - b[3])) / std::numbers::pi; }},
    {"thurber", [](const Numbers& b, const Numbers& x) { return rational(b, x[0]); }},
};

TEST(CurveFit, CertifiedNonlinearSetsFromBothStarts) {
    const std::vector<std::string> ids = reference_ids("strd-nls-");
    EXPECT_EQ(ids.size(), k_strd_formulas.size());
    for (const std::string& id : ids) {
        const json reference = reference_case(id);
        CurveData data = data_of(reference);
        if (id == "strd-nls-nelson") {  // its response is ln(y)
            data.y = data.y.array().log();
        }
        const auto formula = k_strd_formulas.find(id.substr(9));
        ASSERT_NE(formula, k_strd_formulas.end()) << id;
        for (const char* const start_name : {"start1", "start2"}) {
            SCOPED_TRACE(id + " " + start_name);
            const json job = gumcert::test::reference_job(reference, std::string("fit from ") + start_name);
            std::vector<double> values;
            for (const json& parameter : job["fits"]["fit"]["parameters"]) {
                values.push_back(parameter["start"]);
            }
            const Eigen::VectorXd start = vector(values);
            try {
                const CurveFit fit = fit_curve(FormulaCurve(formula->second), data, start,
                                               names_of(static_cast<std::size_t>(start.size())));
                const Digits digits = digits_of(fit, reference);
                RecordProperty(id.substr(9) + "." + start_name, text_of(digits) + ", iterations " +
                                                                    std::to_string(fit.iterations) + ", offset " +
                                                                    std::to_string(std::log10(fit.relative_offset)) +
                                                                    (fit.several_minima ? ", several minima" : ""));
                EXPECT_GE(digits.parameters, 9.0) << text_of(digits);
                EXPECT_GE(digits.standard_deviations, 8.0) << text_of(digits);
                EXPECT_GE(digits.sums, 8.0) << text_of(digits);
            } catch (const gum::DiagnosedError& error) {
                ADD_FAILURE() << error.what();
            }
        }
    }
}

/// A certified set that is written out here.
struct CertifiedSet {
    std::string name;
    Formula formula;
    std::vector<double> x;
    std::vector<double> y;
    std::vector<std::vector<double>> starts;
    std::vector<std::string> parameters;
    std::vector<std::string> standard_deviations;
    std::string sum_of_squares;
};

std::vector<double> equally_spaced(double first, double step, int count) {
    std::vector<double> values;
    for (int i = 0; i < count; ++i) {
        values.push_back(first + step * i);
    }
    return values;
}

/// NIST StRD MGH10, MGH17, Bennett5: the hard ones of the nonlinear sets that are not among the reference cases.
std::vector<CertifiedSet> hard_sets() {
    std::vector<CertifiedSet> sets;
    sets.push_back(
        {.name = "MGH10",
         .formula = [](const Numbers& b, const Numbers& x) { return b[0] * exp(b[1] / (x[0] + b[2])); },
         .x = equally_spaced(50.0, 5.0, 16),
         .y = {34780, 28610, 23650, 19630, 16370, 13720, 11540, 9744, 8261, 7030, 6005, 5147, 4427, 3820, 3307, 2872},
         .starts = {{2.0, 400000.0, 25000.0}, {0.02, 4000.0, 250.0}},
         .parameters = {"5.6096364710E-03", "6.1813463463E+03", "3.4522363462E+02"},
         .standard_deviations = {"1.5687892471E-04", "2.3309021107E+01", "7.8486103508E-01"},
         .sum_of_squares = "8.7945855171E+01"});
    sets.push_back(
        {.name = "MGH17",
         .formula = [](const Numbers& b,
                       const Numbers& x) { return b[0] + b[1] * exp(-x[0] * b[3]) + b[2] * exp(-x[0] * b[4]); },
         .x = equally_spaced(0.0, 10.0, 33),
         .y = {0.844, 0.908, 0.932, 0.936, 0.925, 0.908, 0.881, 0.850, 0.818, 0.784, 0.751,
               0.718, 0.685, 0.658, 0.628, 0.603, 0.580, 0.558, 0.538, 0.522, 0.506, 0.490,
               0.478, 0.467, 0.457, 0.448, 0.438, 0.431, 0.424, 0.420, 0.414, 0.411, 0.406},
         .starts = {{50.0, 150.0, -100.0, 1.0, 2.0}, {0.5, 1.5, -1.0, 0.01, 0.02}},
         .parameters = {"3.7541005211E-01", "1.9358469127E+00", "-1.4646871366E+00", "1.2867534640E-02",
                        "2.2122699662E-02"},
         .standard_deviations = {"2.0723153551E-03", "2.2031669222E-01", "2.2175707739E-01", "4.4861358114E-04",
                                 "8.9471996575E-04"},
         .sum_of_squares = "5.4648946975E-05"});
    sets.push_back(
        {.name = "Bennett5",
         .formula = [](const Numbers& b, const Numbers& x) { return b[0] * pow(b[1] + x[0], -1.0 / b[2]); },
         .x = {7.447168,  8.102586,  8.452547,  8.711278,  8.916774,  9.087155,  9.232590,  9.359535,  9.472166,
               9.573384,  9.665293,  9.749461,  9.827092,  9.899128,  9.966321,  10.029280, 10.088510, 10.144430,
               10.197380, 10.247670, 10.295560, 10.341250, 10.384950, 10.426820, 10.467000, 10.505640, 10.542830,
               10.578690, 10.613310, 10.646780, 10.679150, 10.710520, 10.740920, 10.770440, 10.799100, 10.826970,
               10.854080, 10.880470, 10.906190, 10.931260, 10.955720, 10.979590, 11.002910, 11.025700, 11.047980,
               11.069770, 11.091100, 11.111980, 11.132440, 11.152480, 11.172130, 11.191410, 11.210310, 11.228870,
               11.247090, 11.264980, 11.282560, 11.299840, 11.316820, 11.333520, 11.349940, 11.366100, 11.382000,
               11.397660, 11.413070, 11.428240, 11.443200, 11.457930, 11.472440, 11.486750, 11.500860, 11.514770,
               11.528490, 11.542020, 11.555380, 11.568550, 11.581560, 11.594420, 11.607121, 11.619640, 11.632000,
               11.644210, 11.656280, 11.668200, 11.679980, 11.691620, 11.703130, 11.714510, 11.725760, 11.736880,
               11.747890, 11.758780, 11.769550, 11.780200, 11.790730, 11.801160, 11.811480, 11.821700, 11.831810,
               11.841820, 11.851730, 11.861550, 11.871270, 11.880890, 11.890420, 11.899870, 11.909220, 11.918490,
               11.927680, 11.936780, 11.945790, 11.954730, 11.963590, 11.972370, 11.981070, 11.989700, 11.998260,
               12.006740, 12.015150, 12.023490, 12.031760, 12.039970, 12.048100, 12.056170, 12.064180, 12.072120,
               12.080010, 12.087820, 12.095580, 12.103280, 12.110920, 12.118500, 12.126030, 12.133500, 12.140910,
               12.148270, 12.155570, 12.162830, 12.170030, 12.177170, 12.184270, 12.191320, 12.198320, 12.205270,
               12.212170, 12.219030, 12.225840, 12.232600, 12.239320, 12.245990, 12.252620, 12.259200, 12.265750,
               12.272240},
         .y = {-34.834702, -34.393200, -34.152901, -33.979099, -33.845901, -33.732899, -33.640301, -33.559200,
               -33.486801, -33.423100, -33.365101, -33.313000, -33.260899, -33.217400, -33.176899, -33.139198,
               -33.101601, -33.066799, -33.035000, -33.003101, -32.971298, -32.942299, -32.916302, -32.890202,
               -32.864101, -32.841000, -32.817799, -32.797501, -32.774300, -32.757000, -32.733799, -32.716400,
               -32.699100, -32.678799, -32.661400, -32.644001, -32.626701, -32.612202, -32.597698, -32.583199,
               -32.568699, -32.554298, -32.539799, -32.525299, -32.510799, -32.499199, -32.487598, -32.473202,
               -32.461601, -32.435501, -32.435501, -32.426800, -32.412300, -32.400799, -32.392101, -32.380501,
               -32.366001, -32.357300, -32.348598, -32.339901, -32.328400, -32.319698, -32.311001, -32.299400,
               -32.290699, -32.282001, -32.273300, -32.264599, -32.256001, -32.247299, -32.238602, -32.229900,
               -32.224098, -32.215401, -32.203800, -32.198002, -32.189400, -32.183601, -32.174900, -32.169102,
               -32.163300, -32.154598, -32.145901, -32.140099, -32.131401, -32.125599, -32.119801, -32.111198,
               -32.105400, -32.096699, -32.090900, -32.088001, -32.079300, -32.073502, -32.067699, -32.061901,
               -32.056099, -32.050301, -32.044498, -32.038799, -32.033001, -32.027199, -32.024300, -32.018501,
               -32.012699, -32.004002, -32.001099, -31.995300, -31.989500, -31.983700, -31.977900, -31.972099,
               -31.969299, -31.963501, -31.957701, -31.951900, -31.946100, -31.940300, -31.937401, -31.931601,
               -31.925800, -31.922899, -31.917101, -31.911301, -31.908400, -31.902599, -31.896900, -31.893999,
               -31.888201, -31.885300, -31.882401, -31.876600, -31.873699, -31.867901, -31.862101, -31.859200,
               -31.856300, -31.850500, -31.844700, -31.841801, -31.838900, -31.833099, -31.830200, -31.827299,
               -31.821600, -31.818701, -31.812901, -31.809999, -31.807100, -31.801300, -31.798401, -31.795500,
               -31.789700, -31.786800},
         .starts = {{-2000.0, 50.0, 0.8}, {-1500.0, 45.0, 0.85}},
         .parameters = {"-2.5235058043E+03", "4.6736564644E+01", "9.3218483193E-01"},
         .standard_deviations = {"2.9715175411E+02", "1.2448871856E+00", "2.0272299378E-02"},
         .sum_of_squares = "5.2404744073E-04"});
    return sets;
}

TEST(CurveFit, CertifiedHardSetsFromBothStarts) {
    for (const CertifiedSet& set : hard_sets()) {
        const CurveData data = points(set.x, set.y);
        for (std::size_t s = 0; s < set.starts.size(); ++s) {
            SCOPED_TRACE(set.name + " start " + std::to_string(s + 1));
            try {
                const CurveFit fit =
                    fit_curve(FormulaCurve(set.formula), data, vector(set.starts[s]), names_of(set.parameters.size()));
                Digits digits;
                for (std::size_t k = 0; k < set.parameters.size(); ++k) {
                    const auto i = static_cast<Eigen::Index>(k);
                    digits.parameters =
                        std::min(digits.parameters, correct_digits(fit.parameters[i], set.parameters[k], 11.0));
                    digits.standard_deviations =
                        std::min(digits.standard_deviations,
                                 correct_digits(std::sqrt(fit.covariance(i, i)), set.standard_deviations[k], 11.0));
                }
                digits.sums = correct_digits(fit.sum_of_squares, set.sum_of_squares, 11.0);
                RecordProperty(set.name + ".start" + std::to_string(s + 1),
                               text_of(digits) + ", iterations " + std::to_string(fit.iterations) +
                                   (fit.several_minima ? ", several minima" : ""));
                EXPECT_GE(digits.parameters, 9.0) << text_of(digits);
                EXPECT_GE(digits.standard_deviations, 8.0) << text_of(digits);
                EXPECT_GE(digits.sums, 8.0) << text_of(digits);
            } catch (const gum::DiagnosedError& error) {
                ADD_FAILURE() << error.what();
            }
        }
    }
}

TEST(CurveFit, CertifiedLinearSets) {
    const std::vector<std::string> ids = reference_ids("strd-lin-");
    EXPECT_EQ(ids.size(), 6U);
    for (const std::string& id : ids) {
        SCOPED_TRACE(id);
        const json reference = reference_case(id);
        const CurveData data = data_of(reference);
        const bool through_origin = id == "strd-lin-noint1";
        const auto p = static_cast<std::size_t>(
            std::count_if(reference["expected"].begin(), reference["expected"].end(),
                          [](const json& expected) { return expected["kind"] == "parameter"; }));
        const Polynomial polynomial(static_cast<int>(p) - (through_origin ? 0 : 1), through_origin);
        const Plane plane;
        const Curve& curve = data.x.cols() > 1 ? static_cast<const Curve&>(plane) : polynomial;
        const CurveFit fit = fit_curve(curve, data, {}, names_of(p), !through_origin);
        const Digits digits = digits_of(fit, reference);
        RecordProperty(id.substr(9), text_of(digits));
        EXPECT_GE(digits.parameters, 11.0) << text_of(digits);
        EXPECT_GE(digits.standard_deviations, 11.0) << text_of(digits);
        EXPECT_GE(digits.sums, 11.0) << text_of(digits);
        EXPECT_EQ(fit.iterations, 0);
    }
}

// NIST StRD Wampler2: residuals that are 0 but for the rounding of the values.
TEST(CurveFit, CertifiedWampler2) {
    std::vector<double> y;
    const std::vector<double> x = equally_spaced(0.0, 1.0, 21);
    for (const double v : x) {
        y.push_back((1e5 + v * (1e4 + v * (1e3 + v * (1e2 + v * (10.0 + v))))) / 1e5);
    }
    const CurveFit fit = fit_curve(Polynomial(5), points(x, y), {}, names_of(6));
    const std::vector<std::string> certified{"1.0", "0.1", "0.01", "0.001", "0.0001", "0.00001"};
    for (Eigen::Index k = 0; k < 6; ++k) {
        EXPECT_GE(correct_digits(fit.parameters[k], certified[static_cast<std::size_t>(k)], 15.0), 11.0) << k;
    }
    EXPECT_LT(fit.sum_of_squares, 1e-26);
    EXPECT_NEAR(fit.r_squared.value(), 1.0, 1e-15);
}

// NIST StRD Wampler4 and Wampler5: the residuals of Wampler3, 100 and 10000 times as large.
TEST(CurveFit, CertifiedWampler4And5) {
    const json third = reference_case("strd-lin-wampler3");
    for (const auto& [factor, r_squared] : {std::pair{100.0, std::string("0.957478440825662")},
                                            std::pair{10000.0, std::string("0.224668921574940E-02")}}) {
        CurveData data = data_of(third);
        for (Eigen::Index i = 0; i < data.y.size(); ++i) {
            const double x = data.x(i, 0);
            const double on_curve = 1.0 + x * (1.0 + x * (1.0 + x * (1.0 + x * (1.0 + x))));
            data.y[i] = on_curve + factor * (data.y[i] - on_curve);
        }
        const CurveFit fit = fit_curve(Polynomial(5), data, {}, names_of(6));
        for (Eigen::Index k = 0; k < 6; ++k) {
            EXPECT_GE(correct_digits(fit.parameters[k], "1.0", 15.0), 9.0) << k;
        }
        EXPECT_GE(correct_digits(std::sqrt(fit.covariance(0, 0)) / factor, "2152.32624678170", 15.0), 12.0);
        EXPECT_GE(correct_digits(fit.residual_standard_deviation / factor, "2360.14502379268", 15.0), 12.0);
        EXPECT_GE(correct_digits(fit.sum_of_squares / factor / factor, "83554268.0000000", 15.0), 12.0);
        EXPECT_GE(correct_digits(fit.r_squared.value(), r_squared, 15.0), 12.0);
    }
}

// NIST StRD NoInt2: y = B1 x through the origin.
TEST(CurveFit, CertifiedNoInt2) {
    const CurveFit fit = fit_curve(Polynomial(1, true), points({4, 5, 6}, {3, 4, 4}), {}, {"b"}, false);
    EXPECT_GE(correct_digits(fit.parameters[0], "0.727272727272727", 15.0), 14.0);
    EXPECT_GE(correct_digits(std::sqrt(fit.covariance(0, 0)), "0.420827318078432E-01", 15.0), 14.0);
    EXPECT_GE(correct_digits(fit.residual_standard_deviation, "0.369274472937998", 15.0), 14.0);
    EXPECT_GE(correct_digits(fit.r_squared.value(), "0.993348115299335", 15.0), 14.0);
}

// NIST StRD Filip: a polynomial of degree 10, the hardest linear set. With powers of x in double precision 7.6 digits
// are left; the powers of its decimal digits give the certified ones.
TEST(CurveFit, CertifiedFilip) {
    const std::vector<double> y{
        0.8116, 0.9072, 0.9052, 0.9039, 0.8053, 0.8377, 0.8667, 0.8809, 0.7975, 0.8162, 0.8515, 0.8766, 0.8885, 0.8859,
        0.8959, 0.8913, 0.8959, 0.8971, 0.9021, 0.909,  0.9139, 0.9199, 0.8692, 0.8872, 0.89,   0.891,  0.8977, 0.9035,
        0.9078, 0.7675, 0.7705, 0.7713, 0.7736, 0.7775, 0.7841, 0.7971, 0.8329, 0.8641, 0.8804, 0.7668, 0.7633, 0.7678,
        0.7697, 0.77,   0.7749, 0.7796, 0.7897, 0.8131, 0.8498, 0.8741, 0.8061, 0.846,  0.8751, 0.8856, 0.8919, 0.8934,
        0.894,  0.8957, 0.9047, 0.9129, 0.9209, 0.9219, 0.7739, 0.7681, 0.7665, 0.7703, 0.7702, 0.7761, 0.7809, 0.7961,
        0.8253, 0.8602, 0.8809, 0.8301, 0.8664, 0.8834, 0.8898, 0.8964, 0.8963, 0.9074, 0.9119, 0.9228};
    const std::vector<double> x{
        -6.860120914, -4.324130045, -4.358625055, -4.358426747, -6.955852379, -6.661145254, -6.355462942, -6.118102026,
        -7.115148017, -6.815308569, -6.519993057, -6.204119983, -5.853871964, -6.109523091, -5.79832982,  -5.482672118,
        -5.171791386, -4.851705903, -4.517126416, -4.143573228, -3.709075441, -3.499489089, -6.300769497, -5.953504836,
        -5.642065153, -5.031376979, -4.680685696, -4.329846955, -3.928486195, -8.56735134,  -8.363211311, -8.107682739,
        -7.823908741, -7.522878745, -7.218819279, -6.920818754, -6.628932138, -6.323946875, -5.991399828, -8.781464495,
        -8.663140179, -8.473531488, -8.247337057, -7.971428747, -7.676129393, -7.352812702, -7.072065318, -6.774174009,
        -6.478861916, -6.159517513, -6.835647144, -6.53165267,  -6.224098421, -5.910094889, -5.598599459, -5.290645224,
        -4.974284616, -4.64454848,  -4.290560426, -3.885055584, -3.408378962, -3.13200249,  -8.726767166, -8.66695597,
        -8.511026475, -8.165388579, -7.886056648, -7.588043762, -7.283412422, -6.995678626, -6.691862621, -6.392544977,
        -6.067374056, -6.684029655, -6.378719832, -6.065855188, -5.752272167, -5.132414673, -4.811352704, -4.098269308,
        -3.66174277,  -3.2644011};
    const std::vector<std::string> parameters{
        "-1467.48961422980",      "-2772.17959193342",      "-2316.37108160893",     "-1127.97394098372",
        "-354.478233703349",      "-75.1242017393757",      "-10.8753180355343",     "-1.06221498588947",
        "-0.670191154593408E-01", "-0.246781078275479E-02", "-0.402962525080404E-04"};
    const std::vector<std::string> deviations{"298.084530995537",      "559.779865474950",     "466.477572127796",
                                              "227.204274477751",      "71.6478660875927",     "15.2897178747400",
                                              "2.23691159816033",      "0.221624321934227",    "0.142363763154724E-01",
                                              "0.535617408889821E-03", "0.896632837373868E-05"};
    const CurveFit fit = fit_curve(Polynomial(10), points(x, y), {}, names_of(11));
    Digits digits;
    for (std::size_t k = 0; k < 11; ++k) {
        const auto i = static_cast<Eigen::Index>(k);
        digits.parameters = std::min(digits.parameters, correct_digits(fit.parameters[i], parameters[k], 15.0));
        digits.standard_deviations =
            std::min(digits.standard_deviations, correct_digits(std::sqrt(fit.covariance(i, i)), deviations[k], 15.0));
    }
    digits.sums = std::min(correct_digits(fit.residual_standard_deviation, "0.334801051324544E-02", 15.0),
                           correct_digits(fit.r_squared.value(), "0.996727416185620", 15.0));
    RecordProperty("filip", text_of(digits) + ", condition " + std::to_string(fit.condition_number));
    EXPECT_GE(digits.parameters, 9.0) << text_of(digits);
    EXPECT_GE(digits.standard_deviations, 9.0) << text_of(digits);
    EXPECT_GE(digits.sums, 9.0) << text_of(digits);
}

// R lm, quoted in the GTC tests: the same weights as stated uncertainties and as relative ones.
TEST(CurveFit, WeightedLineKnownAndScaled) {
    CurveData data = points({1, 2, 3, 4, 5, 6}, {3.014, 5.225, 7.004, 9.061, 11.201, 12.762});
    data.y_uncertainty = vector({0.2, 0.2, 0.2, 0.4, 0.4, 0.4});
    const CurveFit known = fit_line(data);
    EXPECT_NEAR(known.parameters[0], 1.13754, 0.5e-5);
    EXPECT_NEAR(known.parameters[1], 1.97264, 0.5e-5);
    EXPECT_NEAR(std::sqrt(known.covariance(0, 0)), 0.21188326, 0.5e-8);
    EXPECT_NEAR(std::sqrt(known.covariance(1, 1)), 0.07115681, 0.5e-8);
    EXPECT_NEAR(known.covariance(0, 1), -0.01316456, 0.5e-8);
    EXPECT_FALSE(known.covariance_scaled);
    data.scale_by_residuals = true;
    const CurveFit scaled = fit_line(data);
    EXPECT_NEAR(std::sqrt(scaled.covariance(0, 0)), 0.12261, 0.5e-5);
    EXPECT_NEAR(std::sqrt(scaled.covariance(1, 1)), 0.04118, 0.5e-5);
    EXPECT_NEAR(scaled.covariance(0, 1), -0.004408553, 0.5e-9);
    EXPECT_TRUE(scaled.covariance_scaled);
    EXPECT_EQ(scaled.parameters, known.parameters);
    // The same uncertainties as a covariance matrix.
    data.y_uncertainty = Eigen::MatrixXd(data.y_uncertainty.col(0).cwiseAbs2().asDiagonal());
    const CurveFit full = fit_line(data);
    EXPECT_TRUE(full.covariance.isApprox(scaled.covariance, 1e-14));
    EXPECT_TRUE(full.parameters.isApprox(scaled.parameters, 1e-14));
}

// ISO/TS 28037:2010, 6.3: equal weights.
TEST(CurveFit, WeightedLineOfIso28037) {
    CurveData data = points({1, 2, 3, 4, 5, 6}, {3.3, 5.6, 7.1, 9.3, 10.7, 12.1});
    data.y_uncertainty = Eigen::VectorXd::Constant(6, 0.5);
    const CurveFit fit = fit_line(data);
    EXPECT_NEAR(fit.parameters[0], 1.866667, 0.5e-6);
    EXPECT_NEAR(fit.parameters[1], 1.757143, 0.5e-6);
    EXPECT_NEAR(std::sqrt(fit.covariance(0, 0)), 0.4654747, 0.5e-7);
    EXPECT_NEAR(std::sqrt(fit.covariance(1, 1)), 0.1195229, 0.5e-7);
    EXPECT_NEAR(fit.covariance(0, 1), -0.050, 0.5e-3);
    EXPECT_NEAR(fit.sum_of_squares, 1.665, 0.5e-3);
    EXPECT_EQ(fit.degrees_of_freedom, 4.0);
}

CurveData uncertain_in_both() {
    CurveData data = points({1.2, 1.9, 2.9, 4.0, 4.7, 5.9}, {3.4, 4.4, 7.2, 8.5, 10.8, 13.5});
    data.x_uncertainty = Eigen::VectorXd::Constant(6, 0.2);
    data.y_uncertainty = vector({0.2, 0.2, 0.2, 0.4, 0.4, 0.4});
    return data;
}

// ISO/TS 28037:2010, clause 7: uncertainties in both variables.
TEST(CurveFit, UncertainAbscissaeOfIso28037) {
    const CurveData data = uncertain_in_both();
    const CurveFit fit = fit_line(data);
    EXPECT_NEAR(fit.parameters[0], 0.5788, 0.5e-4);
    EXPECT_NEAR(fit.parameters[1], 2.1597, 0.5e-4);
    EXPECT_NEAR(std::sqrt(fit.covariance(0, 0)), 0.4764, 0.5e-4);
    EXPECT_NEAR(std::sqrt(fit.covariance(1, 1)), 0.1355, 0.5e-4);
    EXPECT_NEAR(fit.covariance(0, 1), -0.0577, 0.5e-4);
    EXPECT_NEAR(fit.sum_of_squares, 2.743, 0.5e-3);
    // Recomputed with more digits.
    EXPECT_NEAR(fit.parameters[0], 0.578822122149499, 1e-12);
    EXPECT_NEAR(fit.parameters[1], 2.15965656739929, 1e-12);
    EXPECT_NEAR(fit.sum_of_squares, 2.74267678973096, 1e-12);
    EXPECT_FALSE(fit.r_squared.has_value());
    EXPECT_LT(fit.relative_offset, 1e-9);

    CurveData full = data;
    full.x_uncertainty = Eigen::MatrixXd(data.x_uncertainty.col(0).cwiseAbs2().asDiagonal());
    full.y_uncertainty = Eigen::MatrixXd(data.y_uncertainty.col(0).cwiseAbs2().asDiagonal());
    const CurveFit other = fit_line(full);
    EXPECT_TRUE(other.parameters.isApprox(fit.parameters, 1e-12));
    EXPECT_TRUE(other.covariance.isApprox(fit.covariance, 1e-10));
    EXPECT_TRUE(other.adjusted_x.isApprox(fit.adjusted_x, 1e-12));
}

// A line whose two variables change places is the same line: only errors in both variables can say so.
TEST(CurveFit, UncertainAbscissaeAreSymmetric) {
    CurveData data = uncertain_in_both();
    Eigen::MatrixXd covariance = data.y_uncertainty.col(0).cwiseAbs2().asDiagonal();
    covariance(0, 1) = covariance(1, 0) = 0.02;
    covariance(3, 5) = covariance(5, 3) = 0.09;
    data.y_uncertainty = covariance;
    const CurveFit forward = fit_line(data);
    CurveData exchanged;
    exchanged.x = data.y;
    exchanged.y = data.x.col(0);
    exchanged.x_uncertainty = data.y_uncertainty;
    exchanged.y_uncertainty = data.x_uncertainty;
    const CurveFit backward = fit_line(exchanged);
    EXPECT_NEAR(backward.parameters[1], 1.0 / forward.parameters[1], 1e-11);
    EXPECT_NEAR(backward.parameters[0], -forward.parameters[0] / forward.parameters[1], 1e-11);
    EXPECT_NEAR(backward.sum_of_squares, forward.sum_of_squares, 1e-11);
    EXPECT_TRUE((forward.residuals + forward.parameters[0] * Eigen::VectorXd::Ones(6) +
                 forward.parameters[1] * forward.adjusted_x.col(0))
                    .isApprox(data.y, 1e-12));
}

// With abscissae of vanishing uncertainty the fit is the ordinary weighted one.
TEST(CurveFit, UncertainAbscissaeOfACurve) {
    const FormulaCurve decay([](const Numbers& b, const Numbers& x) { return b[0] * exp(-b[1] * x[0]); });
    CurveData data = points({0, 1, 2, 3, 4, 5}, {10.1, 6.2, 3.6, 2.3, 1.3, 0.85});
    data.y_uncertainty = Eigen::VectorXd::Constant(6, 0.1);
    const CurveFit exact = fit_curve(decay, data, vector({8.0, 0.3}), {"a", "b"});
    data.x_uncertainty = Eigen::VectorXd::Constant(6, 1e-7);
    const CurveFit nearly = fit_curve(decay, data, vector({8.0, 0.3}), {"a", "b"});
    EXPECT_TRUE(nearly.parameters.isApprox(exact.parameters, 1e-10));
    EXPECT_TRUE(nearly.covariance.isApprox(exact.covariance, 1e-10));
    data.x_uncertainty = Eigen::VectorXd::Constant(6, 0.05);
    const CurveFit both = fit_curve(decay, data, vector({8.0, 0.3}), {"a", "b"});
    EXPECT_GT(both.covariance(0, 0), exact.covariance(0, 0));
    EXPECT_LT(both.sum_of_squares, exact.sum_of_squares);
}

// JCGM 100:2008, H.3: calibration line of a thermometer.
TEST(CurveFit, ThermometerOfTheGum) {
    const json reference = reference_case("gum-h3-thermometer");
    CurveData data;
    data.x = vector(reference["data"]["t"].get<std::vector<double>>()).array() - 20.0;
    data.y = vector(reference["data"]["b"].get<std::vector<double>>());
    const CurveFit fit = fit_curve(k_line, data, {}, {"y1", "y2"});
    EXPECT_NEAR(fit.parameters[0], -0.1712, 0.5e-4);
    EXPECT_NEAR(fit.parameters[1], 0.00218, 0.5e-5);
    EXPECT_NEAR(std::sqrt(fit.covariance(0, 0)), 0.0029, 0.5e-4);
    EXPECT_NEAR(std::sqrt(fit.covariance(1, 1)), 0.00067, 0.5e-5);
    EXPECT_NEAR(correlation(fit), -0.930, 0.5e-3);
    EXPECT_NEAR(fit.residual_standard_deviation, 0.0035, 0.5e-4);
    EXPECT_EQ(fit.degrees_of_freedom, 9.0);
    const Eigen::Vector2d at_30(1.0, 10.0);
    EXPECT_NEAR(at_30.dot(fit.parameters), -0.1494, 0.5e-4);
    EXPECT_NEAR(std::sqrt(at_30.dot(fit.covariance * at_30)), 0.0041, 0.5e-4);
}

// Glantz, height and weight.
TEST(CurveFit, HeightAndWeight) {
    const json reference = reference_case("glantz-height-weight");
    const CurveFit fit = fit_line(data_of(reference));
    EXPECT_NEAR(fit.parameters[1], 0.44, 0.5e-2);
    EXPECT_NEAR(fit.parameters[0], -6.0, 0.5e-1);
    EXPECT_NEAR(std::sqrt(fit.covariance(1, 1)), 0.064, 0.5e-3);
    EXPECT_NEAR(std::sqrt(fit.covariance(0, 0)), 2.4, 0.5e-1);
}

// Sandia, decay of a leak standard: values about 1e-8.
TEST(CurveFit, LeakStandard) {
    const FormulaCurve decay([](const Numbers& b, const Numbers& x) { return b[0] * exp(-b[1] * x[0]); });
    const CurveData data = points({1, 380, 794, 1247, 1673, 2031, 2747},
                                  {6.635e-8, 6.531e-8, 6.354e-8, 6.255e-8, 6.212e-8, 5.97e-8, 5.907e-8});
    const CurveFit fit = fit_curve(decay, data, vector({6.5e-8, 4.5e-5}), {"a", "b"});
    EXPECT_NEAR(fit.parameters[0], 6.621e-8, half_unit("6.621E-8"));
    EXPECT_NEAR(fit.parameters[1], 4.404e-5, half_unit("4.404E-5"));
    EXPECT_NEAR(std::sqrt(fit.covariance(0, 0)), 3.66537425069531e-10, 1e-20);
    EXPECT_NEAR(std::sqrt(fit.covariance(1, 1)), 3.71969455491046e-6, 1e-16);
}

// A unit changes numbers, not the fit.
TEST(CurveFit, ScalesWithTheUnit) {
    const FormulaCurve decay([](const Numbers& b, const Numbers& x) { return b[0] * exp(-b[1] * x[0]); });
    CurveData data = points({0, 1, 2, 3, 4, 5}, {10.1, 6.2, 3.6, 2.3, 1.3, 0.85});
    const CurveFit metres = fit_curve(decay, data, vector({8.0, 0.3}), {"a", "b"});
    data.y *= 1e-12;
    data.x *= 1e9;
    const CurveFit other = fit_curve(decay, data, vector({8.0e-12, 0.3e-9}), {"a", "b"});
    EXPECT_NEAR(other.parameters[0] / metres.parameters[0], 1e-12, 1e-23);
    EXPECT_NEAR(other.parameters[1] / metres.parameters[1], 1e-9, 1e-20);
    EXPECT_NEAR(other.covariance(0, 1) / metres.covariance(0, 1), 1e-21, 1e-31);
}

// Values that lie on the curve: residuals of rounding size are a result, not a failure.
TEST(CurveFit, ValuesOnTheCurve) {
    const FormulaCurve decay([](const Numbers& b, const Numbers& x) { return b[0] * exp(-b[1] * x[0]); });
    std::vector<double> x{0, 1, 2, 3, 4, 5};
    std::vector<double> y;
    for (const double v : x) {
        y.push_back(3.0 * std::exp(-0.7 * v));
    }
    CurveData data = points(x, y);
    const CurveFit fit = fit_curve(decay, data, vector({1.0, 0.1}), {"a", "b"});
    EXPECT_NEAR(fit.parameters[0], 3.0, 1e-14);
    EXPECT_NEAR(fit.parameters[1], 0.7, 1e-14);
    // As many points as parameters, with stated uncertainties.
    data = points({0, 1}, {y[0], y[1]});
    data.y_uncertainty = Eigen::VectorXd::Constant(2, 0.1);
    const CurveFit through = fit_curve(decay, data, vector({1.0, 0.1}), {"a", "b"});
    EXPECT_NEAR(through.parameters[1], 0.7, 1e-14);
    EXPECT_NEAR(through.covariance(0, 0), 0.01, 1e-14);
    EXPECT_EQ(through.degrees_of_freedom, 0.0);
    EXPECT_EQ(through.residual_standard_deviation, 0.0);
    // All values equal: no R².
    EXPECT_FALSE(fit_line(points({1, 2, 3}, {4, 4, 4})).r_squared.has_value());
}

// No minimum: the sum of squares falls for ever as a grows, to that of no curve at all.
TEST(CurveFit, CurveWithoutAMinimumIsRefused) {
    const FormulaCurve falling([](const Numbers& b, const Numbers& x) { return exp(-b[0]) * x[0]; });
    const CurveData negative = points({1, 2, 3, 4}, {-1.0, -2.1, -2.9, -4.0});
    try {
        const CurveFit fit = fit_curve(falling, negative, vector({1.0}), {"a"});
        ADD_FAILURE() << "a = " << fit.parameters[0] << " was given";
    } catch (const gum::NoResultError& error) {
        EXPECT_FALSE(error.diagnostics().front().action.empty());
    }
}

template <class Failure>
std::string code_of(const std::function<void()>& call) {
    try {
        call();
    } catch (const Failure& failure) {
        return failure.diagnostics().front().code;
    } catch (const std::exception& failure) {
        return std::string("another failure: ") + failure.what();
    }
    return "no failure";
}

TEST(CurveFit, RefusesBadInput) {
    const CurveData good = points({1, 2, 3, 4}, {1.1, 1.9, 3.2, 3.9});
    const auto code = [&](const std::function<void(CurveData&)>& spoil) {
        CurveData data = good;
        spoil(data);
        return code_of<gum::InputError>([&] { (void)fit_line(data); });
    };
    EXPECT_EQ(code([](CurveData& data) { data.x.conservativeResize(3, 1); }), "GC-FIT-0001");
    EXPECT_EQ(code([](CurveData& data) { data.y_uncertainty = Eigen::VectorXd::Ones(3); }), "GC-FIT-0001");
    EXPECT_EQ(code([](CurveData& data) { data.y_uncertainty = Eigen::MatrixXd::Ones(4, 2); }), "GC-FIT-0001");
    EXPECT_EQ(code([](CurveData& data) { data.y[2] = std::nan(""); }), "GC-FIT-0002");
    EXPECT_EQ(code([](CurveData& data) { data.x(0, 0) = std::numeric_limits<double>::infinity(); }), "GC-FIT-0002");
    EXPECT_EQ(code([](CurveData& data) { data = points({1, 2}, {1, 2}); }), "GC-FIT-0003");
    EXPECT_EQ(code([](CurveData& data) {
                  data = points({1}, {1});
                  data.y_uncertainty = Eigen::VectorXd::Ones(1);
              }),
              "GC-FIT-0003");
    EXPECT_EQ(code([](CurveData& data) { data.y_uncertainty = vector({0.1, 0.0, 0.1, 0.1}); }), "GC-FIT-0004");
    EXPECT_EQ(code([](CurveData& data) { data.y_uncertainty = vector({0.1, -0.1, 0.1, 0.1}); }), "GC-FIT-0004");
    EXPECT_EQ(code([](CurveData& data) { data.y_uncertainty = vector({0.1, 0.1, std::nan(""), 0.1}); }), "GC-FIT-0004");
    EXPECT_EQ(code([](CurveData& data) { data.y_uncertainty = Eigen::MatrixXd::Ones(4, 4); }), "GC-FIT-0005");
    EXPECT_EQ(code([](CurveData& data) {
                  data.y_uncertainty = Eigen::MatrixXd::Identity(4, 4);
                  data.y_uncertainty(0, 1) = 0.5;
              }),
              "GC-FIT-0005");
    EXPECT_EQ(code([](CurveData& data) {
                  data.y_uncertainty = Eigen::MatrixXd::Identity(4, 4);
                  data.y_uncertainty(0, 1) = data.y_uncertainty(1, 0) = std::nan("");
              }),
              "GC-FIT-0005");
    EXPECT_EQ(code([](CurveData& data) { data.x_uncertainty = Eigen::VectorXd::Ones(4); }), "GC-FIT-0007");
    EXPECT_EQ(code([](CurveData& data) {
                  data.x = Eigen::MatrixXd::Random(4, 2);
                  data.x_uncertainty = Eigen::VectorXd::Ones(4);
                  data.y_uncertainty = Eigen::VectorXd::Ones(4);
              }),
              "GC-FIT-0007");
    const FormulaCurve decay([](const Numbers& b, const Numbers& x) { return b[0] * exp(-b[1] * x[0]); });
    EXPECT_EQ(code_of<gum::InputError>([&] {
                  (void)fit_curve(decay, good, vector({1.0}), {"a", "b"});
              }),
              "GC-FIT-0006");
    EXPECT_EQ(code_of<gum::InputError>([&] {
                  (void)fit_curve(decay, good, vector({1.0, std::nan("")}), {"a", "b"});
              }),
              "GC-FIT-0006");
    EXPECT_EQ(code_of<gum::InputError>([&] { (void)fit_curve(decay, good, {}, {}); }), "GC-FIT-0001");
    const FormulaCurve logarithm([](const Numbers& b, const Numbers& x) { return log(b[0]) * x[0]; });
    EXPECT_EQ(code_of<gum::NoResultError>([&] { (void)fit_curve(logarithm, good, vector({-1.0}), {"a"}); }),
              "GC-FIT-0013");
    // Everything that is wrong is told at once.
    CurveData bad = good;
    bad.y[0] = std::nan("");
    bad.y_uncertainty = vector({0.1, 0.0, 0.1, 0.1});
    try {
        (void)fit_line(bad);
        ADD_FAILURE() << "accepted";
    } catch (const gum::InputError& error) {
        EXPECT_EQ(error.diagnostics().size(), 2U);
        EXPECT_EQ(gum::message(error.diagnostics()[1]),
                  "point 2, uncertainty of y — 0 — must be finite and greater than 0: it is a weight — "
                  "State a standard uncertainty greater than 0.");
    }
}

TEST(CurveFit, NamesWhatThePointsDoNotDetermine) {
    const auto refusal = [](const std::function<void()>& call) -> gum::Diagnostic {
        try {
            call();
        } catch (const gum::NoResultError& error) {
            return error.diagnostics().front();
        }
        return {};
    };
    // All points at one abscissa.
    const gum::Diagnostic same_x = refusal([] { (void)fit_line(points({2, 2, 2}, {1.0, 1.1, 0.9})); });
    EXPECT_EQ(same_x.code, "GC-FIT-0010");
    EXPECT_EQ(same_x.what, "the points do not determine the parameters a, b apart from each other");
    // A column of zeros.
    const gum::Diagnostic zero = refusal([] { (void)fit_line(points({0, 0, 0}, {1.0, 1.1, 0.9})); });
    EXPECT_EQ(zero.what, "the points do not determine the parameter b");
    // A product of two parameters.
    const FormulaCurve product([](const Numbers& b, const Numbers& x) { return b[0] * b[1] * exp(-b[2] * x[0]); });
    const gum::Diagnostic factor = refusal([&] {
        (void)fit_curve(product, points({0, 1, 2, 3, 4}, {10.1, 6.2, 3.6, 2.3, 1.3}), vector({2.0, 4.0, 0.4}),
                        {"gain", "amplitude", "rate"});
    });
    EXPECT_EQ(factor.code, "GC-FIT-0010");
    EXPECT_EQ(factor.what, "the points do not determine the parameters gain, amplitude apart from each other");
}

TEST(CurveFit, RefusesACurveThatIsNotLinearThoughItSaysSo) {
    class Wrong final : public Curve {
    public:
        double evaluate(const Eigen::VectorXd& x, const Eigen::VectorXd& parameters, Eigen::VectorXd& by_parameter,
                        Eigen::VectorXd& by_x) const override {
            by_parameter << 1.0, x[0] + 0.1 * parameters[1];
            by_x << parameters[1];
            return parameters[0] + parameters[1] * x[0] + 0.05 * parameters[1] * parameters[1];
        }
        [[nodiscard]] bool is_linear() const override { return true; }
    };
    EXPECT_EQ(code_of<gum::NoResultError>([] {
                  (void)fit_curve(Wrong(), points({1, 2, 3, 4}, {1.1, 1.9, 3.2, 3.9}), {}, {"a", "b"});
              }),
              "GC-FIT-0014");
}

}  // namespace
}  // namespace gumcert::engine

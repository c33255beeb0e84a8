#include "archive/certificates/archive_statistics.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>

#include "gum/distribution_quantile.h"
#include "json/canonical_json.h"
#include "json/members.h"
#include "text/degrees_of_freedom.h"
#include "text/lists.h"
#include "text/numbers.h"
#include "text/visible_text.h"

namespace gumcert::archive {

namespace {

using nlohmann::json;

constexpr double k_beyond = 0.00135;  // as beyond three standard deviations of a normal distribution, on one side

/// The x that Snedecor's F with ν₁ and ν₂ degrees of freedom exceeds with probability k_beyond: ν₂/ν₁ (1 − y)/y, where y is
/// the quantile of the beta distribution with ν₂/2 and ν₁/2.
double upper_limit_of_F(std::int64_t nu_1, std::int64_t nu_2) {
    gum::Distribution beta;
    beta.kind = gum::DistributionKind::beta;
    beta.scale = 1.0;
    beta.shape = 0.5 * static_cast<double>(nu_2);
    beta.second_shape = 0.5 * static_cast<double>(nu_1);
    const double y = gum::quantile(beta, k_beyond);
    return static_cast<double>(nu_2) / static_cast<double>(nu_1) * ((1.0 - y) / y);
}

/// Whether readings are all equal, or differ by one step of their last digit: then their scatter is that of the display.
/// \param observations  as they are written: "213.43"
bool differ_by_one_step(const json& observations) {
    std::vector<std::string> texts;
    std::vector<double> values;
    for (const json& one : observations) {
        const std::string text = one.is_string() ? one.get<std::string>() : std::string();
        double value = 0.0;
        if (std::from_chars(text.data(), text.data() + text.size(), value).ec != std::errc()) {
            return false;
        }
        texts.push_back(text);
        values.push_back(value);
    }
    if (values.empty()) {
        return false;
    }
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    constexpr double k_more_than_one = 1.5;
    return *most - *least < k_more_than_one * std::pow(10.0, -text::most_decimals(texts));
}

/// What some sets of readings say of their common standard deviation.
struct PooledScatter {
    double squares = 0.0;  ///< Σ ν s²
    std::int64_t nu = 0;   ///< Σ ν

    void add(const ArchivedScatter& one) {
        squares += static_cast<double>(one.n - 1) * one.standard_deviation * one.standard_deviation;
        nu += one.n - 1;
    }
    [[nodiscard]] double standard_deviation() const { return std::sqrt(squares / static_cast<double>(nu)); }
};

/// In control the standard deviation of n readings is above its limit with probability k_beyond.
class LimitsOfScatter {
public:
    /// \param others  with which it is compared; where all their readings are equal, by their resolution, they say nothing of how
    ///                readings scatter, and there is no limit
    [[nodiscard]] std::optional<double> of(const PooledScatter& others, std::int64_t n) {
        if (!(others.squares > 0.0)) {
            return std::nullopt;
        }
        const auto [known, is_new] = factors_.try_emplace({n, others.nu});
        if (is_new) {
            known->second = std::sqrt(upper_limit_of_F(n - 1, others.nu));
        }
        return others.standard_deviation() * known->second;
    }

private:
    std::map<std::pair<std::int64_t, std::int64_t>, double> factors_;
};

/// Methods of a certificate: sections may have one of their own.
class MethodsOfCertificate {
public:
    /// \param record  with its certificate
    explicit MethodsOfCertificate(const json& record) {
        const json& certificate = gumcert::json::part_of(record, "certificate");
        const json& data = gumcert::json::part_of(certificate, "data");
        method_ = method_of(data);
        std::map<std::string, std::string> own;
        for (const json& section : gumcert::json::part_of(data, "sections")) {
            if (const std::string method = method_of(section); !method.empty()) {
                own[gumcert::json::text_of(section, "section")] = method;
            }
        }
        const auto of_section = [&](const std::string& name) {
            const auto found = own.find(name);
            return found == own.end() ? method_ : found->second;
        };
        for (const json& section : gumcert::json::part_of(record, "sections")) {
            all_.insert(of_section(gumcert::json::text_of(section, "name")));
        }
        for (const json& table : gumcert::json::part_of(certificate, "tables")) {
            const std::string method = of_section(gumcert::json::text_of(table, "section"));
            for (const json& point : gumcert::json::part_of(gumcert::json::part_of(table, "argument"), "printed")) {
                if (point.is_string()) {
                    of_point_[point.get<std::string>()].insert(method);
                }
            }
        }
        if (all_.empty()) {
            all_.insert(method_);
        }
    }

    [[nodiscard]] const std::set<std::string>& all() const { return all_; }
    /// Of readings at a point; where sections of several methods have a point of this name, all of them.
    [[nodiscard]] std::string at(const std::string& point) const {
        const auto found = of_point_.find(point);
        if (found == of_point_.end()) {
            return method_;
        }
        std::string methods;
        for (const std::string& method : found->second) {
            methods += (methods.empty() ? "" : " / ") + method;
        }
        return methods;
    }

private:
    std::string method_;
    std::set<std::string> all_;
    std::map<std::string, std::set<std::string>> of_point_;

    static std::string method_of(const json& part) {
        return gumcert::json::text_of(gumcert::json::part_of(part, "method"), "identification");
    }
};

class StatisticsOfRecords {
public:
    void look_at(const ListedCertificate& certificate, const std::string& bytes) {
        if (certificate.state == "withdrawn") {
            return;
        }
        const json record = json::parse(bytes, nullptr, false);
        if (!record.is_object()) {
            found_.not_read.push_back(certificate.number);
            return;
        }
        const json& data = gumcert::json::part_of(gumcert::json::part_of(record, "certificate"), "data");
        const MethodsOfCertificate methods(record);
        const json& dates = gumcert::json::part_of(data, "dates");
        if (certificate.state != "drafted" && certificate.state != "reviewed" && certificate.state != "authorised") {
            const CertificateLife& life = lives_.at(certificate.number);
            count(found_.by_month, life.issued_at.substr(0, 7));
            count(found_.by_authoriser, life.authorised_by);
            count(found_.by_kind, gumcert::json::text_of(record, "kind"));
            for (const std::string& method : methods.all()) {
                count(found_.by_method, method);
            }
            found_.amendments += life.amends.empty() ? 0U : 1U;  // reports of comparisons, too
        }
        const std::string done = gumcert::json::text_of(dates, "performed_to");
        const std::string day = done.empty() ? gumcert::json::text_of(dates, "performed_from") : done;
        if (!states_its_measurement(lives_.at(certificate.number))) {
            return;
        }
        take_scores(certificate.number, day, gumcert::json::part_of(record, "comparison"));
        take_readings(certificate.number, day, methods, gumcert::json::part_of(record, "readings"));
    }
    void begin(const std::map<std::string, CertificateLife>& lives) {
        lives_ = lives;
        for (const auto& [number, life] : lives_) {
            count(found_.by_state, life.state);
        }
    }

    ArchiveStatistics finish() && {
        std::sort(found_.scores.begin(), found_.scores.end(), [](const ArchivedScores& a, const ArchivedScores& b) {
            return std::tie(a.day, a.number) < std::tie(b.day, b.number);
        });
        for (auto& [key, scatters] : scatters_) {
            const double usual = usual_scatter(scatters);
            const auto value_of = [&](const ArchivedScatter& one) { return size_of(one, usual); };
            std::sort(scatters.begin(), scatters.end(), [&](const ArchivedScatter& x, const ArchivedScatter& y) {
                return std::tuple(value_of(x), x.day, x.number) < std::tuple(value_of(y), y.day, y.number);
            });
            std::vector<std::vector<ArchivedScatter>> charts;
            std::vector<ArchivedScatter> alone;
            for (auto first = scatters.begin(); first != scatters.end();) {
                const auto last = std::find_if(first, scatters.end(), [&](const ArchivedScatter& one) {
                    return value_of(one) > k_near * value_of(*first);
                });
                if (last - first > 1) {
                    charts.emplace_back(first, last);
                } else {
                    alone.push_back(*first);
                }
                first = last;
            }
            std::vector<double> near;
            std::transform(charts.begin(), charts.end(), std::back_inserter(near),
                           [&](const std::vector<ArchivedScatter>& chart) { return value_of(chart.front()); });
            const std::vector<std::vector<ArchivedScatter>> of_their_means = charts;
            for (ArchivedScatter& one : alone) {
                const auto chart = std::find_if(of_their_means.begin(), of_their_means.end(), [&](const auto& sets) {
                    return is_displaced_from(one, value_of(one), value_of(sets.front()), value_of(sets.back()), sets);
                });
                if (chart != of_their_means.end()) {
                    charts[static_cast<std::size_t>(chart - of_their_means.begin())].push_back(std::move(one));
                } else {
                    UnchartedScatter told{.scatter = std::move(one)};
                    std::tie(told.method, told.input, told.unit) = key;
                    found_.uncharted.push_back(std::move(told));
                }
            }
            for (std::size_t i = 0; i < charts.size(); ++i) {
                found_.charts.push_back(chart_of(key, near[i], std::move(charts[i])));
            }
        }
        return std::move(found_);
    }

private:
    using ChartKey = std::tuple<std::string, std::string, std::string>;
    static constexpr double k_near = 1.05;
    ArchiveStatistics found_;
    std::map<std::string, CertificateLife> lives_;  // as the log says
    std::map<ChartKey, std::vector<ArchivedScatter>> scatters_;

    /// Of a certificate and what amends or replaces it the one that holds has the readings: they were taken once.
    static bool states_its_measurement(const CertificateLife& life) {
        const bool is_amended = life.state == "amended-by" || life.state == "superseded";
        return !is_amended && (life.amends.empty() || life.state == "issued");
    }
    static bool by_day(const ArchivedScatter& a, const ArchivedScatter& b) {
        return std::tie(a.day, a.number) < std::tie(b.day, b.number);
    }
    /// The median standard deviation of all sets of an input, of two the smaller one. A set that is out of control, and has a
    /// larger one, stays among those with its mean: its own scatter does not choose with what it is compared.
    static double usual_scatter(const std::vector<ArchivedScatter>& scatters) {
        std::vector<double> all;
        for (const ArchivedScatter& one : scatters) {
            all.push_back(one.standard_deviation);
        }
        const auto middle = all.begin() + static_cast<std::ptrdiff_t>((all.size() - 1) / 2);
        std::nth_element(all.begin(), middle, all.end());
        return *middle;
    }
    /// By which sets of readings are compared with each other.
    static double size_of(const ArchivedScatter& one, double usual) {
        constexpr double k_away = 10.0;  // usual standard deviations
        const double size = std::abs(one.mean);
        return size > k_away * usual ? size : 0.0;
    }
    /// Whether a set has no others near it only because it scatters: as far as its own readings tell (three standard deviations
    /// of their mean) they may be of a value of the chart, of which their scatter is beyond the limit.
    static bool is_displaced_from(const ArchivedScatter& one, double value, double lowest, double highest,
                                  const std::vector<ArchivedScatter>& chart) {
        if (one.has_one_step) {
            return false;
        }
        const double reach = 3.0 * one.standard_deviation / std::sqrt(static_cast<double>(one.n));
        PooledScatter pooled;
        std::for_each(chart.begin(), chart.end(), [&](const ArchivedScatter& other) { pooled.add(other); });
        const std::optional<double> limit = LimitsOfScatter().of(pooled, one.n);
        return value + reach >= lowest && value - reach <= highest && limit && one.standard_deviation > *limit;
    }
    static RepeatabilityChart chart_of(const ChartKey& key, double near, std::vector<ArchivedScatter> scatters) {
        RepeatabilityChart chart;
        std::tie(chart.method, chart.input, chart.unit) = key;
        chart.near = near;
        std::sort(scatters.begin(), scatters.end(), by_day);
        PooledScatter all;
        std::vector<PooledScatter> before;  // of each set
        for (const ArchivedScatter& one : scatters) {
            before.push_back(all);
            all.add(one);
        }
        chart.pooled_standard_deviation = all.standard_deviation();
        chart.degrees_of_freedom = all.nu;
        // A set is held against the others: it would raise a limit that it is in, and of a few sets none could be above.
        LimitsOfScatter limits;
        PooledScatter behind;
        for (std::size_t i = scatters.size(); i-- > 0;) {
            PooledScatter others = before[i];
            others.squares += behind.squares;
            others.nu += behind.nu;
            scatters[i].limit = scatters[i].has_one_step ? std::nullopt : limits.of(others, scatters[i].n);
            behind.add(scatters[i]);
        }
        chart.scatters = std::move(scatters);
        return chart;
    }

    static void count(std::map<std::string, std::size_t>& counts, const std::string& name) {
        ++counts[name.empty() ? "(not stated)" : name];
    }

    static void add_score(ArchivedScores& scores, const json& row) {
        const json& En = gumcert::json::part_of(row, "En");
        if (En.is_number()) {
            const double size = std::abs(En.get<double>());
            ++scores.scores;
            scores.above_one += size > 1.0 ? 1U : 0U;
            scores.largest = std::max(scores.largest, size);
        }
    }
    /// Of points, or of the participants at each item. Pairs of participants are no scores of their own.
    void take_scores(const std::string& number, const std::string& day, const json& comparison) {
        const std::string issued = gumcert::json::text_of(gumcert::json::part_of(comparison, "issuer"), "issued");
        ArchivedScores scores{.number = number, .day = day.empty() ? issued : day};
        for (const json& point : gumcert::json::part_of(comparison, "points")) {
            add_score(scores, point);
        }
        if (scores.scores > 0) {
            found_.scores.push_back(std::move(scores));
        }
    }

    void take_readings(const std::string& number, const std::string& day, const MethodsOfCertificate& methods,
                       const json& readings) {
        for (const json& one : readings) {
            const json& s = gumcert::json::part_of(one, "standard_deviation");
            const json& mean = gumcert::json::part_of(one, "mean");
            const json& n = gumcert::json::part_of(one, "n");
            if (!s.is_number() || !mean.is_number() || !n.is_number_integer() || n.get<std::int64_t>() < 2) {
                continue;
            }
            const std::string component = gumcert::json::text_of(one, "component");
            const std::string input =
                gumcert::json::text_of(one, "input") + (component.empty() ? "" : ", " + component);
            const std::string method = methods.at(gumcert::json::text_of(one, "point"));
            scatters_[{method, input, gumcert::json::text_of(one, "unit")}].push_back(
                {.number = number,
                 .day = day,
                 .mean = mean.get<double>(),
                 .standard_deviation = s.get<double>(),
                 .n = n.get<std::int64_t>(),
                 .has_one_step = differ_by_one_step(gumcert::json::part_of(one, "observations"))});
        }
    }
};

std::string digits(double value) {
    return text::significant(value, 3);
}

std::string counts_as_text(const char* title, const std::map<std::string, std::size_t>& counts) {
    std::string text;
    for (const auto& [name, count] : counts) {
        text += text.empty() ? std::string(title) + "\n" : "";
        const std::string number = std::to_string(count);
        text += "  " + std::string(number.size() < 7 ? 7 - number.size() : 0, ' ') + number + "  " +
                text::visible(name, 100) + "\n";
    }
    return text;
}

std::string place_of(const RepeatabilityChart& chart) {
    return text::visible(chart.method.empty() ? "(no method)" : chart.method, 60) + ", " +
           text::visible(chart.input, 60) + " near " + digits(chart.near) + " " + text::visible(chart.unit, 20);
}

}  // namespace

ArchiveStatistics statistics_of(Archive& archive) {
    StatisticsOfRecords all;
    archive.each_record(
        [&](const std::map<std::string, CertificateLife>& lives) { all.begin(lives); },
        [&](const ListedCertificate& certificate, const std::string& bytes) { all.look_at(certificate, bytes); });
    ArchiveStatistics found = std::move(all).finish();
    found.set_back = archive.times().set_back();
    return found;
}

std::string statistics_text(const ArchiveStatistics& statistics) {
    std::string text = counts_as_text("Certificates by state", statistics.by_state) +
                       counts_as_text("Issued, by month", statistics.by_month) +
                       counts_as_text("Issued, by who authorised them", statistics.by_authoriser) +
                       counts_as_text("Issued, by method", statistics.by_method) +
                       counts_as_text("Issued, by kind of evaluation", statistics.by_kind);
    text += "Amendments that were issued: " + std::to_string(statistics.amendments) + "\n";
    if (const std::string set_back = in_words(statistics.set_back); !set_back.empty()) {
        text += "Clocks that were ahead: " + set_back + "\n";
    }
    for (const ArchivedScores& one : statistics.scores) {
        text += &one == statistics.scores.data() ? "|E_n| of comparisons: scores, above 1, largest\n" : "";
        text += "  " + text::visible(one.number, 40) + "  " + text::visible(one.day, 20) + "  " +
                std::to_string(one.scores) + "  " + std::to_string(one.above_one) + "  " + digits(one.largest) + "\n";
    }
    for (const RepeatabilityChart& chart : statistics.charts) {
        text += &chart == statistics.charts.data() ? "Repeatability: pooled standard deviation of a reading\n" : "";
        text += "  " + place_of(chart) + ": " + digits(chart.pooled_standard_deviation) + " " +
                text::visible(chart.unit, 20) + ", " +
                text::degrees_of_freedom(std::to_string(chart.degrees_of_freedom)) + ", " +
                text::count_of(static_cast<std::int64_t>(chart.scatters.size()), "set") + " of readings\n";
        for (const ArchivedScatter& one : chart.scatters) {
            if (one.is_above()) {
                text += "    ABOVE THE LIMIT: " + text::visible(one.number, 40) + "  " + text::visible(one.day, 20) +
                        "  " + digits(one.standard_deviation) + " of " + std::to_string(one.n) + " readings, limit " +
                        digits(*one.limit) + "\n";
            }
        }
    }
    for (const UnchartedScatter& one : statistics.uncharted) {
        text += &one == statistics.uncharted.data() ? "In no chart, because no other readings are near them\n" : "";
        text += "  " + text::visible(one.method.empty() ? "(no method)" : one.method, 60) + ", " +
                text::visible(one.input, 60) + ": " + text::visible(one.scatter.number, 40) + "  " +
                text::visible(one.scatter.day, 20) + "  " + digits(one.scatter.standard_deviation) + " of " +
                text::count_of(static_cast<std::int64_t>(one.scatter.n), "reading") + " near " +
                digits(one.scatter.mean) + " " + text::visible(one.unit, 20) + "\n";
    }
    for (const std::string& number : statistics.not_read) {
        text += "Not read: the record of " + text::visible(number, 80) + "\n";
    }
    return text;
}

std::string statistics_json(const ArchiveStatistics& statistics) {
    json scores = json::array();
    for (const ArchivedScores& one : statistics.scores) {
        scores.push_back({{"number", one.number},
                          {"day", one.day},
                          {"scores", one.scores},
                          {"above_one", one.above_one},
                          {"largest", one.largest}});
    }
    json charts = json::array();
    for (const RepeatabilityChart& chart : statistics.charts) {
        json values = json::array();
        for (const ArchivedScatter& one : chart.scatters) {
            values.push_back({{"number", one.number},
                              {"day", one.day},
                              {"mean", one.mean},
                              {"standard_deviation", one.standard_deviation},
                              {"n", one.n},
                              {"limit", one.limit ? json(*one.limit) : json()},
                              {"above", one.is_above()}});
        }
        charts.push_back({{"method", chart.method},
                          {"input", chart.input},
                          {"near", chart.near},
                          {"unit", chart.unit},
                          {"pooled_standard_deviation", chart.pooled_standard_deviation},
                          {"degrees_of_freedom", chart.degrees_of_freedom},
                          {"values", std::move(values)}});
    }
    json uncharted = json::array();
    for (const UnchartedScatter& one : statistics.uncharted) {
        uncharted.push_back({{"method", one.method},
                             {"input", one.input},
                             {"unit", one.unit},
                             {"number", one.scatter.number},
                             {"day", one.scatter.day},
                             {"mean", one.scatter.mean},
                             {"standard_deviation", one.scatter.standard_deviation},
                             {"n", one.scatter.n}});
    }
    return gumcert::json::canonical_json({{"schema", "gumcert/archive-statistics/1"},
                                          {"by_state", statistics.by_state},
                                          {"by_month", statistics.by_month},
                                          {"by_authoriser", statistics.by_authoriser},
                                          {"by_method", statistics.by_method},
                                          {"by_kind", statistics.by_kind},
                                          {"amendments", statistics.amendments},
                                          {"clocks_set_back", to_json(statistics.set_back)},
                                          {"not_read", statistics.not_read},
                                          {"scores", std::move(scores)},
                                          {"charts", std::move(charts)},
                                          {"uncharted", std::move(uncharted)}});
}

}  // namespace gumcert::archive

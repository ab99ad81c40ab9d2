#include <cstdio>
#include <fstream>
#include <vkhausdorff/vkhausdorff.hpp>

int main(int argc, char** argv) {  // everything A B FIELD.ply CERTIFICATE.vhc
  if (argc < 5) return 2;
  const auto a = std::make_shared<const vkh::ReadMesh>(vkh::read_mesh(argv[1]));
  const auto b = std::make_shared<const vkh::ReadMesh>(vkh::read_mesh(argv[2]));
  vkh::Device device;
  vkh::Solver solver(device);
  vkh::Solver* const solvers[] = {&solver};  // or one on each device: they share A's faces

  vkh::Question question;
  question.tolerance = vkh::parse_length("tolerance", "1e-6diag", vkh::PlainNumber::kRefused);
  question.bands = {vkh::parse_length("bands", "0.1abs", vkh::PlainNumber::kRefused)};
  question.faces = question.statistics = true;  // bounds of each face; mean, percentiles, bands
  question.certificate = true;
  question.verify = true;  // the host checks the witness against every face of B
  question.budget.time_limit_s = 60;

  vkh::Asking asking(question, a, b, solvers);  // and a std::stop_token, if any
  while (!asking.wait(std::chrono::steady_clock::now() + std::chrono::seconds(1))) {
    const vkh::WorkDone done = asking.done();  // asking.cancel() would end it
    std::printf("%.0f %%  [%.9g, %.9g]\n", 100 * done.fraction, done.lower, done.upper);
  }
  const vkh::Answer answer = asking.answer();  // throws what went wrong
  const vkh::Report& r = answer.a_to_b;
  const vkh::Statistics& s = *answer.survey_a->statistics;
  std::printf("%.17g <= h(A, B) <= %.17g: %s\n", r.lower, r.upper, vkh::status_name(r.status));
  std::printf("mean in [%.9g, %.9g], at least %.9g of the area within %g\n", s.mean.lower,
              s.mean.upper, s.bands[0].share.lower, s.bands[0].distance);

  const vkh::FieldFile field{.mesh = *a,
                             .field = answer.survey_a->field,
                             .interval = {r.lower, r.upper},
                             .unit = answer.unit,
                             .against = b->name};
  std::ofstream(argv[3], std::ios::binary) << vkh::to_ply(field);
  std::ofstream(argv[4], std::ios::binary)
      << vkh::certificate_of({*a, {}}, {*b, {}}, {r, *answer.proof_a}, {});
  return r.witness_check->holds ? 0 : 1;
}

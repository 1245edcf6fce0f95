#include <folk/strategies/standard/rosters.h>

#include <string>
#include <utility>

namespace folk {
namespace {

/// The names of Axelrod-Python's strategies in the order of the alphabet there, then those that mix.
constexpr const char* axelrod_library =
    "aon_2,adaptive_pavlov_2006,adaptive_pavlov_2011,adaptive,adaptive_tit_for_tat,aggravater,alexei,"
    "axelrod_alternator,alternator_hunter,anti_cycler,anti_tit_for_tat,appeaser,back_stabber,bully,capri,"
    "collective_strategy,contrite_tit_for_tat,all_c,cooperator_hunter,cycle_hunter,per_cccccd,per_cccd,per_cccdcd,"
    "per_ccd,per_dc,per_ddc,dbs,all_d,defector_hunter,delayed_aon_1,detective,double_crosser,double_resurrection,"
    "doubler,easy_go,eugine_nier,eventual_cycle_hunter,evolved_ann,evolved_ann_5,evolved_ann_noise_05,"
    "evolved_fsm_16,evolved_fsm_16_noise_05,evolved_fsm_4,evolved_fsm_6,evolved_looker_up_1_1_1,"
    "evolved_looker_up_2_2_2,first_by_davis,first_by_downing,first_by_nydegger,first_by_shubik,"
    "first_by_stein_and_rapoport,first_by_tideman_and_chieruzzi,fool_me_once,forgetful_grudger,forgiver,"
    "forgiving_tit_for_tat,fortress_3,fortress_4,general_soft_grudger,soft_majo,go_by_majority_10,"
    "go_by_majority_20,go_by_majority_40,go_by_majority_5,golden,gradual,gradual_killer,grudger,grudger_alternator,"
    "grumpy,handshake,hard_majo,hard_go_by_majority_10,hard_go_by_majority_20,hard_go_by_majority_40,"
    "hard_go_by_majority_5,hard_prober,hard_tit_for_2_tats,hard_tit_for_tat,inverse_punisher,level_punisher,"
    "limited_retaliate,limited_retaliate_2,limited_retaliate_3,mem2,math_constant_hunter,n_tits_for_m_tats,"
    "omega_tft,once_bitten,opposite_grudger,gradual_soft,pi,predator,prober,prober_2,prober_3,prober_4,pun_1,"
    "punisher,raider,random_hunter,resurrection,retaliate,retaliate_2,retaliate_3,revised_downing,ripoff,"
    "second_by_borufsen,second_by_colbert,second_by_gladstein,second_by_graaskamp_katzen,second_by_grofman,"
    "second_by_mikkelson,second_by_richard_hufford,second_by_rowsam,second_by_tester,"
    "second_by_tideman_and_chieruzzi,second_by_weiner,second_by_white,second_by_yamachi,short_mem,slow_tft,"
    "sneaky_tit_for_tat,soft_grudger,solution_b1,solution_b5,spiteful_tit_for_tat,axelrod_spiteful_cc,mistrust,tf1,"
    "tf2,tf3,thue_morse,thue_morse_inverse,thumper,tf2t,tit_for_tat,tricky_cooperator,tricky_defector,"
    "tricky_level_punisher,two_tits_for_tat,usually_cooperates,usually_defects,very_bad,win_shift_lose_stay,pavlov,"
    "winner12,axelrod_winner21,e,meta_hunter,meta_hunter_aggressive,first_by_anonymous,first_by_feld,"
    "first_by_graaskamp,first_by_grofman,first_by_joss,first_by_tullock,calculator,"
    "all_c_or_all_d,desperate,hopeless,negation,random_tit_for_tat,willing,firm_but_fair,stochastic_cooperator,"
    "stochastic_wsls,soft_joss,generous_tit_for_tat,zd_extortion,zd_extort_2,zd_extort_2_v2,zd_extort_3,"
    "zd_extort_4,zd_gen_2,zd_gtft_2,zd_mischief,zd_set_2,second_by_appold,second_by_black,second_by_cave,"
    "second_by_champion,second_by_eatherley,second_by_getzler,second_by_kluepfel,second_by_leyvraz,"
    "second_by_wm_adams";

}  // namespace

void add_rosters(Registry& registry) {
  constexpr const char* first =
      "all_c,all_d,tit_for_tat,spiteful,soft_majo,hard_majo,per_ddc,per_ccd,mistrust,per_cd,"
      "pavlov,tf2t,hard_tft,slow_tft,";
  registry.add_roster({"classics", {}, "the 17 classical strategies", "Mathieu & Delahaye, JASSS 20(4) 12, 2017, 3.3"},
                      std::string(first) + "gradual,prober,mem2");
  registry.add_roster({"sct2025",
                       {},
                       "the classics with gradual_sct and mem2_sct, as the SCT paper's program plays them",
                       "arXiv 2310.04579v2"},
                      std::string(first) + "gradual_sct,prober,mem2_sct");
  std::string all;
  for (const auto& description : registry.strategies())
    if (description.name.find_first_of("(<@:") == std::string::npos) all += description.name + ",";
  registry.add_roster(
      {"all", {}, "every named strategy without parameters but those of axelrod_library alone", "ipd-strategies list"},
      std::move(all));
}

void add_library_rosters(Registry& registry) {
  registry.add_roster({"axelrod1980",
                       {},
                       "the 15 entrants of Axelrod's first tournament",
                       "Axelrod, Journal of Conflict Resolution 24(1), 1980"},
                      "tit_for_tat,first_by_tideman_and_chieruzzi,first_by_nydegger,first_by_grofman,first_by_shubik,"
                      "first_by_stein_and_rapoport,grudger,first_by_davis,first_by_graaskamp,first_by_downing,"
                      "first_by_feld,first_by_joss,first_by_tullock,first_by_anonymous,lunatic");
  registry.add_roster({"stewart_plotkin2012",
                       {},
                       "the 19 strategies of Stewart and Plotkin's tournament",
                       "Stewart & Plotkin, PNAS 109, 2012; by its names, as Axelrod-Python 4.13.0 takes them"},
                      "all_c,all_d,tit_for_tat,tf2t,gtft(1/3),lunatic,zd_generous(2;3/8),grudger,hard_tit_for_tat,"
                      "hard_tit_for_2_tats,pavlov,zd_extort(2;1/18),hard_majo,first_by_joss,prober,prober_2,prober_3,"
                      "hard_prober,calculator");
  registry.add_roster({"axelrod_library",
                       {},
                       "the strategies of Axelrod-Python that are here, 151 deterministic and 36 that mix",
                       "Axelrod-Python 4.13.0"},
                      axelrod_library);
}

}  // namespace folk

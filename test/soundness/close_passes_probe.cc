#include <chrono>
#include <cstdio>
#include <cstdlib>
#include "core/collision/arbiter.h"
#include "core/collision/scene_bodies.h"
#include "core/trajectory/stopping_reach.h"
#include "test/bench/cells.h"
#include "test/soundness/band.h"
#include "test/soundness/pairs.h"
using namespace armloom; using namespace armloom::soundness;
int main(int argc,char**argv){
  const std::size_t pool_n=argc>1?atoi(argv[1]):40, pairs_n=argc>2?atoi(argv[2]):1500;
  const double tracking=argc>3?atof(argv[3]):0.001;
  Cell cell=*bench::two_pandas(); cell.clearance_m=0.005; cell.self_clearance_m=std::min(cell.self_clearance_m,0.005);
  auto shared=std::make_shared<const Cell>(cell);
  bench::ExactScene exact(shared);
  Pool pool(exact,pool_n,77);
  auto pairs=random_pairs(exact,pool,pairs_n,78);
  std::mt19937_64 rng(5);
  struct M{const char*name;CheckMethod m;};
  const M methods[]={{"certified",Certified{cell.checking.delay,true,tracking}},{"swept",Swept{tracking}}};
  for(const M&m:methods){
    int free=0,conflict=0,und=0,exh=0; 
    struct U{std::size_t i;double d;};
    for(std::size_t i=0;i<pairs.size();++i){
      Arbiter arbiter(exact.scene);
      Question q=pairs[i].question(cell,m.m); 
      Verdict v=arbiter.judge(q);
      if(v.kind==Verdict::Kind::free){++free;continue;}
      if(v.kind==Verdict::Kind::conflict){++conflict;continue;}
      ++und; exh+=v.exhausted;
      Promise p=promise_of(cell,pairs[i],m.m);
      double d=attack(exact,pairs[i],p,0.05,rng).distance_m;
      Promise p0=p; p0.tracking_error=0;
      double d0=attack(exact,pairs[i],p0,0.05,rng).distance_m;
      std::printf("%s pair %zu exh %d with-tracking %.2f mm plan %.2f mm conf %.2f mm:",m.name,i,int(v.exhausted),d*1e3,d0*1e3,v.conflicts[0].proximity.clearance_m*1e3);
      std::uint64_t total=v.evaluations; auto t0=std::chrono::steady_clock::now();
      for(std::uint64_t e=4;e<=1024 && v.kind==Verdict::Kind::undecided && v.exhausted;e*=4){ q.effort=e; v=arbiter.judge(q); total+=v.evaluations; 
        std::printf(" e%lu:%s(%lu)",(unsigned long)e,v.kind==Verdict::Kind::free?"free":v.kind==Verdict::Kind::conflict?"conflict":"undecided",(unsigned long)total);}
      std::printf(" %.1f ms\n",std::chrono::duration<double>(std::chrono::steady_clock::now()-t0).count()*1e3);
      std::fflush(stdout);
    }
    std::printf("%s: free %d conflict %d undecided %d (exhausted %d)\n",m.name,free,conflict,und,exh);
  }
  if (argc > 4) {
    for (std::uint64_t e : {1, 4, 16, 64}) {
      int none=0,proven=0,unproven=0,clear_unproven=0; std::uint64_t evals=0; double worst=0;
      auto t0=std::chrono::steady_clock::now();
      for(std::size_t i=0;i<pairs.size();++i){
        Arbiter arbiter(exact.scene);
        Question q=pairs[i].question(cell,Coordinated{tracking}); q.effort=e;
        auto t1=std::chrono::steady_clock::now();
        Verdict v=arbiter.judge(q);
        worst=std::max(worst,std::chrono::duration<double>(std::chrono::steady_clock::now()-t1).count());
        evals+=v.evaluations;
        if(v.regions.empty()) ++none; else if(!v.exhausted) ++proven; else {
          ++unproven;
          double least=1; for(auto&r:v.regions) for(auto&c:r.regions) least=std::min(least,c.proximity.clearance_m);
          if(least>=0.007) {++clear_unproven; }
        }
      }
      std::printf("coordinated effort %lu: no region %d, all proven %d, some unproven %d (nearest known >= 7 mm %d), evals %lu, %.1f s, worst %.2f s\n",(unsigned long)e,none,proven,unproven,clear_unproven,(unsigned long)evals,std::chrono::duration<double>(std::chrono::steady_clock::now()-t0).count(),worst);
      std::fflush(stdout);
    }
  }
}

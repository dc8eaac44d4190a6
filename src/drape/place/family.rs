//! Which pieces are laid together: those that seams join at their sides, round the trunk; those of
//! one sleeve, round its arm.

use super::joins::{Joins, Seen};
use super::layplan::{self, Lay};
use super::{Wrapped, leg, section};
use crate::garment::scene::{Placement, Side};
use crate::mesh::compiled::Compiled;

/// Pieces that go round the trunk together.
pub(super) struct Family<'a> {
    /// One of them that is placed, or the one that it hangs on.
    pub root: &'a Wrapped<'a>,
    /// Its pieces.
    pub members: Vec<Member>,
    /// Least room between it and the body, m.
    pub gap: f64,
    /// Whether it takes its height from what it is sewn to.
    pub hung: bool,
}

impl Family<'_> {
    /// Least and greatest height of its pieces as they lie, m; `None` if there are none.
    pub fn heights(&self, compiled: &Compiled, joins: &Joins) -> Option<[f64; 2]> {
        let all = self.members.iter().flat_map(|member| {
            let particles = compiled.panels[member.panel].particles.range();
            particles.map(|k| member.lay.at(joins.drawn[k])[1])
        });
        all.fold(None, |span: Option<[f64; 2]>, y| {
            let [low, high] = span.unwrap_or([y; 2]);
            Some([low.min(y), high.max(y)])
        })
    }
}

/// A piece of a family.
pub(super) struct Member {
    /// Its panel.
    pub panel: usize,
    /// Where it lies in the plane.
    pub lay: Lay,
    /// Where it was placed; led pieces like their partner.
    pub side: Side,
}

/// A sleeve and what is sewn on to it.
pub(super) struct Limb<'a> {
    /// The piece that is placed.
    pub root: &'a Wrapped<'a>,
    /// The others, each with where it lies in the plane of the first.
    pub led: Vec<(usize, Lay)>,
}

/// All pieces that go round something.
pub(super) struct Families<'a> {
    pub trunk: Vec<Family<'a>>,
    pub limbs: Vec<Limb<'a>>,
    /// Pieces of trousers, which lie already.
    legs: Vec<&'a Wrapped<'a>>,
}

impl<'a> Families<'a> {
    /// Joins the pieces that are placed, and takes in what they lead.
    pub fn new(compiled: &Compiled, joins: &Joins, wrapped: &'a [Wrapped<'a>]) -> Self {
        let (legs, round): (Vec<&Wrapped>, Vec<&Wrapped>) =
            wrapped.iter().partition(|w| leg::is_leg(compiled, w));
        let limbs = round.iter().filter(|w| w.limb().is_some());
        let mut families = Families {
            trunk: side_by_side(compiled, joins, &round),
            limbs: limbs.map(|root| Limb { root, led: Vec::new() }).collect(),
            legs,
        };
        families.lead(compiled, joins);
        families.unite(compiled, joins);
        families
    }

    /// Takes in panels that nothing places, as long as a seam leads to one.
    fn lead(&mut self, compiled: &Compiled, joins: &Joins) {
        let mut led: Vec<usize> = (0..compiled.panels.len())
            .filter(|n| matches!(compiled.panels[*n].placement, Placement::Led))
            .collect();
        loop {
            let before = led.len();
            led.retain(|panel| !self.take_in(compiled, joins, *panel));
            if led.len() == before {
                break;
            }
        }
    }

    /// Takes in one panel where its longest join leads. Gives whether there was any.
    fn take_in(&mut self, compiled: &Compiled, joins: &Joins, panel: usize) -> bool {
        let leg = |other: usize| self.legs.iter().copied().find(|w| w.number == other);
        let known = |other: usize| {
            self.in_trunk(other).is_some() || self.on_limb(other).is_some() || leg(other).is_some()
        };
        let mut longest: Option<Seen> = None;
        for seen in joins.of(panel).filter(|s| s.count() > 1 && known(s.other)) {
            if longest.as_ref().is_none_or(|l| l.count() < seen.count()) {
                longest = Some(seen);
            }
        }
        let Some(seen) = longest else { return false };
        // A gusset lies between both and follows when they lie.
        let on = |is: &dyn Fn(usize) -> bool| joins.of(panel).any(|s| is(s.other));
        if on(&|p| self.on_limb(p).is_some()) && on(&|p| self.in_trunk(p).is_some()) {
            return false;
        }
        if let Some((limb, partner)) = self.on_limb(seen.other) {
            let lay = layplan::lay_below(compiled, joins, (panel, &seen), &partner);
            self.limbs[limb].led.push((panel, lay));
            return true;
        }
        if let Some(root) = leg(seen.other) {
            // A waistband; what lies beside a leg is led by itself.
            let lay = Lay { turn: layplan::turn(joins, &seen, &Lay::default()), ..Lay::default() };
            let beside = layplan::is_beside(joins, &seen, &lay, &Lay::default());
            if !beside {
                let members = vec![Member { panel, lay, side: Side::Around }];
                self.trunk.push(Family { root, members, gap: root.gap, hung: true });
            }
            return !beside;
        }
        let Some((family, member)) = self.in_trunk(seen.other) else { return false };
        let partner = &self.trunk[family].members[member];
        let Family { root, gap, .. } = self.trunk[family];
        let side = partner.side;
        let upright = Lay { turn: layplan::turn(joins, &seen, &partner.lay), ..Lay::default() };
        if layplan::is_beside(joins, &seen, &upright, &partner.lay) && root.whole.is_none() {
            let lay = layplan::lay_beside(compiled, joins, (panel, &seen), &partner.lay, None);
            self.trunk[family].members.push(Member { panel, lay, side });
        } else {
            let members = vec![Member { panel, lay: upright, side: Side::Around }];
            self.trunk.push(Family { root, members, gap, hung: true });
        }
        true
    }

    /// Makes one family of those whose led pieces meet at their sides, a front and a back that have
    /// side pieces between them, and of a front and a back at one height.
    fn unite(&mut self, compiled: &Compiled, joins: &Joins) {
        let beside = |a: &Family, b: &Family| {
            a.members.iter().any(|m| {
                joins.of(m.panel).any(|seen| {
                    b.members.iter().any(|n| {
                        n.panel == seen.other && layplan::is_beside(joins, &seen, &m.lay, &n.lay)
                    })
                })
            })
        };
        let is = |f: &Family, side: Side| f.members.iter().all(|m| m.side == side);
        let opposite = |a: &Family, b: &Family| {
            let turned = |a, b| is(a, Side::Before) && is(b, Side::Behind);
            if !(turned(a, b) || turned(b, a)) {
                return false;
            }
            let body = a.root.body;
            let (a, b) = (a.heights(compiled, joins), b.heights(compiled, joins));
            let (Some(a), Some(b)) = (a, b) else { return false };
            if section::collar_base(body, a[0].max(b[0])).is_some() {
                return false;
            }
            a[1].min(b[1]) - a[0].max(b[0]) > 0.5 * (a[1] - a[0]).min(b[1] - b[0])
        };
        let meet = |a: &Family, b: &Family| {
            !a.hung
                && !b.hung
                && a.root.may_adjoin(b.root, compiled)
                && (beside(a, b) || opposite(a, b))
        };
        let mut first = 0;
        while first < self.trunk.len() {
            let found = (first + 1..self.trunk.len())
                .find(|other| meet(&self.trunk[first], &self.trunk[*other]));
            match found {
                Some(other) => {
                    let other = self.trunk.remove(other);
                    let family = &mut self.trunk[first];
                    family.gap = family.gap.min(other.gap);
                    family.members.extend(other.members);
                }
                None => first += 1,
            }
        }
    }

    /// The family of a panel round the trunk, and its number there.
    fn in_trunk(&self, panel: usize) -> Option<(usize, usize)> {
        self.trunk.iter().enumerate().find_map(|(n, family)| {
            family.members.iter().position(|m| m.panel == panel).map(|m| (n, m))
        })
    }

    /// The limb that a panel goes round, and how it lies there.
    fn on_limb(&self, panel: usize) -> Option<(usize, Lay)> {
        self.limbs.iter().enumerate().find_map(|(n, limb)| {
            if limb.root.number == panel {
                return Some((n, Lay::default()));
            }
            limb.led.iter().find(|(p, _)| *p == panel).map(|(_, lay)| (n, *lay))
        })
    }
}

/// Families of the panels placed at the trunk: of one body, one layer, joined at their sides.
fn side_by_side<'a>(
    compiled: &Compiled,
    joins: &Joins,
    round: &[&'a Wrapped<'a>],
) -> Vec<Family<'a>> {
    let trunk: Vec<&Wrapped> = round.iter().filter(|w| w.limb().is_none()).copied().collect();
    let start = |w: &Wrapped| {
        let right = w.panel(compiled).name.ends_with("right");
        let part = match w.side {
            Side::Before | Side::Around => 0.0,
            Side::Behind => 0.5,
            Side::Beside if right => 0.75,
            Side::Beside => 0.25,
        };
        Lay { part, turn: 0.0, origin: [0.0, w.height() - w.anchor] }
    };
    let mut taken = vec![false; trunk.len()];
    let mut families = Vec::new();
    for first in 0..trunk.len() {
        if std::mem::replace(&mut taken[first], true) {
            continue;
        }
        let member = |w: &Wrapped, lay| Member { panel: w.number, lay, side: w.side };
        let mut members = vec![member(trunk[first], start(trunk[first]))];
        let (mut next, mut used) = (0, 0);
        let mut sides = 0;
        while next < members.len() {
            let (panel, partner) = (members[next].panel, members[next].lay);
            let Some(here) = trunk.iter().find(|w| w.number == panel) else { break };
            for seen in joins.of(panel).filter(|s| s.count() > 1) {
                let Some(n) = trunk.iter().position(|w| w.number == seen.other) else { continue };
                let other = trunk[n];
                if !here.may_adjoin(other, compiled)
                    || !layplan::is_beside(joins, &seen, &partner, &start(other))
                {
                    continue;
                }
                sides += 1;
                if std::mem::replace(&mut taken[n], true) {
                    continue;
                }
                used += 1;
                let mut lay = start(other);
                if other.side == Side::Around {
                    // As the partner sees it from the other side of the seam.
                    let back = joins
                        .of(other.number)
                        .find(|s| s.other == panel && s.count() == seen.count());
                    if let Some(back) = back {
                        let height = Some(lay.origin[1]);
                        let piece = (other.number, &back);
                        lay = layplan::lay_beside(compiled, joins, piece, &partner, height);
                    }
                }
                members.push(member(other, lay));
            }
            next += 1;
        }
        // Every seam was met from both sides; one more than the pieces need closes the round.
        if members.iter().all(|m| m.side == Side::Around) && sides / 2 > used {
            spread(compiled, joins, &mut members);
        }
        let of = |m: &Member| trunk.iter().find(|w| w.number == m.panel).map(|w| w.gap);
        let gap = members.iter().filter_map(of).fold(f64::INFINITY, f64::min);
        families.push(Family { root: trunk[first], members, gap, hung: false });
    }
    families
}

/// Gives pieces that close to a round each its own part of it.
fn spread(compiled: &Compiled, joins: &Joins, members: &mut [Member]) {
    let across: Vec<[f64; 2]> = members
        .iter()
        .map(|m| {
            let x = compiled.panels[m.panel].particles.range();
            let x = x.map(|k| m.lay.at(joins.drawn[k])[0]);
            x.fold([f64::INFINITY, f64::NEG_INFINITY], |r, x| [r[0].min(x), r[1].max(x)])
        })
        .collect();
    let whole: f64 = across.iter().map(|r| r[1] - r[0] + layplan::MEETING).sum();
    let middle = |r: &[f64; 2]| 0.5 * (r[0] + r[1]);
    for (member, r) in members.iter_mut().zip(&across) {
        let way = middle(r) - middle(&across[0]);
        member.lay.part += way / whole;
        member.lay.origin[0] -= way;
    }
}

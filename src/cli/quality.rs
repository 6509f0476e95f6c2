//! What the program says about the quality of a mesh: lines for people, JSON for programs.
use super::page::Page;
use super::summary::grouped;
use delotet::query::quality::{forced_tets, skinny_tets, worst_tets, Figures, BINS, FORCED_BELOW};
use delotet::query::{ForcedTet, Measure, QualitySummary, SkinnyCause, SkinnyTet, SkinnyTets, TetQuality};
use delotet::{Error, TetMesh, INVALID};
use serde_json::{json, Value};
use std::collections::BTreeMap;

/// How many of the worst tetrahedra are listed for each measure.
const LISTED: usize = 10;

/// The quality of a mesh; none if it was not asked for.
#[derive(Default)]
pub struct Quality {
    pub forced: Vec<ForcedTet>,
    /// If a ratio was asked for.
    pub skinny: Option<SkinnyTets>,
    summary: Option<QualitySummary>,
}

impl Quality {
    pub fn of(mesh: &TetMesh) -> Result<Quality, Error> {
        let forced = forced_tets(mesh)?;
        let summary = Some(QualitySummary::new(mesh, &forced));
        let skinny = mesh.ratio.map(|ratio| skinny_tets(mesh, Some(ratio), &forced)).transpose()?;
        Ok(Quality { forced, skinny, summary })
    }

    /// A few lines: the range of dihedral angles, histograms, and how much of it the input forces.
    pub fn describe(&self, page: &mut Page) {
        let Some(summary) = self.summary.as_ref().filter(|summary| summary.tet_count > 0) else { return };
        let [least, most, ratio, eta] = summary.all.worst;
        page.line("dihedrals", format_args!("{least:.3}° to {most:.3}°"));
        page.line("  smallest", histogram(&summary.all, Measure::MinDihedral));
        page.line("  largest", histogram(&summary.all, Measure::MaxDihedral));
        page.line("radius-edge", format_args!("up to {ratio:.3}"));
        page.line("", histogram(&summary.all, Measure::RadiusEdge));
        if let Some(skinny) = &self.skinny {
            page.line("", above(skinny));
        }
        page.line("mean ratio", format_args!("down to {eta:.4}"));
        page.line("", histogram(&summary.all, Measure::Eta));
        let Some(narrowest) = self.forced.iter().min_by(|a, b| a.angle.total_cmp(&b.angle)) else { return };
        let count = grouped(summary.forced_count);
        let ([a, b], angle) = (narrowest.facets, narrowest.angle);
        page.line(
            "input-forced",
            format_args!(
                "{count} in wedges below {FORCED_BELOW}° between facets; the narrowest, {angle:.3}°, between {a} and {b}"
            ),
        );
        let [least, most, ratio, eta] = summary.unforced.worst;
        if summary.unforced.worst_tet[0] != INVALID {
            page.line(
                "  the others",
                format_args!(
                    "{least:.3}° to {most:.3}°, radius-edge up to {ratio:.3}, mean ratio down to {eta:.4}"
                ),
            );
        }
    }

    /// Worst values, histograms, and the worst tetrahedra by each measure.
    pub fn as_json(&self, mesh: &TetMesh) -> Result<Value, Error> {
        let Some(summary) = &self.summary else { return Ok(Value::Null) };
        let mut measures = serde_json::Map::new();
        for (i, measure) in Measure::ALL.into_iter().enumerate() {
            let of = |figures: &Figures, worst: Value| json!({ "worst": worst, "histogram": figures.histograms[i] });
            let bins: Vec<&str> = (0..BINS).map(|bin| measure.bin_name(bin)).collect();
            let value = json!({
                "bins": bins,
                "all": of(&summary.all, worst(mesh, measure, &[])?),
                "unforced": of(&summary.unforced, worst(mesh, measure, &self.forced)?),
            });
            measures.insert(key(measure).to_string(), value);
        }
        measures.insert("tets".to_string(), json!(summary.tet_count));
        measures.insert("forced".to_string(), json!(summary.forced_count));
        measures.insert("skinny".to_string(), self.skinny.as_ref().map_or(Value::Null, skinny_counts));
        Ok(Value::Object(measures))
    }
}

/// The bins that are not empty, each by its upper bound.
fn histogram(figures: &Figures, measure: Measure) -> String {
    let edges = measure.bin_edges();
    let label = |bin: usize| match bin + 1 < BINS {
        // Three decimals are enough to recognize the root of two.
        true => format!("<{}", (edges[bin + 1] * 1000.0).round() / 1000.0),
        false => format!(">={}", edges[bin]),
    };
    let counts = figures.histograms[measure as usize].iter().enumerate().filter(|bin| *bin.1 > 0);
    let parts = counts.map(|(bin, &count)| format!("{} {}", label(bin), grouped(count)));
    parts.collect::<Vec<_>>().join(", ")
}

/// How many tetrahedra are above the ratio that was asked for, and why.
fn above(skinny: &SkinnyTets) -> String {
    let ratio = skinny.ratio;
    let count =
        |of: &dyn Fn(SkinnyCause) -> bool| skinny.list.iter().filter(|tet| of(tet.cause)).count() as u64;
    let forced = count(&SkinnyCause::is_forced);
    let [beside, other] = [SkinnyCause::Beside, SkinnyCause::Other].map(|cause| count(&|x| x == cause));
    match skinny.list.len() as u64 {
        0 => format!("none above {ratio}"),
        all => format!(
            "{} above {ratio}: {} input-forced, {} beside these, {} others",
            grouped(all),
            grouped(forced),
            grouped(beside),
            grouped(other)
        ),
    }
}

fn skinny_counts(skinny: &SkinnyTets) -> Value {
    let mut counts = serde_json::Map::new();
    counts.insert("ratio".to_string(), json!(skinny.ratio));
    counts.insert("tets".to_string(), json!(skinny.list.len()));
    for cause in SkinnyCause::ALL {
        counts.insert(cause.name().to_string(), json!(skinny.count(cause)));
    }
    Value::Object(counts)
}

/// The tetrahedra above the ratio that was asked for, with the facets that force them.
pub fn above_ratio(skinny: Option<&SkinnyTets>) -> Value {
    let facets = |tet: &SkinnyTet| (tet.cause != SkinnyCause::Other).then_some(tet.facets);
    let tet = |tet: &SkinnyTet| json!({ "tet": tet.tet, "radius_edge": tet.radius_edge, "cause": tet.cause.name(), "facets": facets(tet) });
    skinny.map_or(Value::Null, |skinny| skinny.list.iter().map(tet).collect())
}

fn key(measure: Measure) -> &'static str {
    match measure {
        Measure::MinDihedral => "min_dihedral",
        Measure::MaxDihedral => "max_dihedral",
        Measure::RadiusEdge => "radius_edge",
        Measure::Eta => "eta",
    }
}

/// The worst tetrahedra by a measure, with their values.
fn worst(mesh: &TetMesh, measure: Measure, without: &[ForcedTet]) -> Result<Value, Error> {
    let mut tets = [INVALID; LISTED];
    let count = worst_tets(mesh, measure, without, &mut tets)?;
    let value = |tet: u32| TetQuality::of_tet(mesh, &mesh.tets[tet as usize]).by(measure);
    Ok(tets[..count].iter().map(|&tet| json!({ "tet": tet, "value": value(tet) })).collect())
}

/// The pairs of facets with narrow wedges between them: the narrowest angle, and how many tetrahedra they force.
pub fn forcing_facets(forced: &[ForcedTet]) -> Value {
    let mut pairs: BTreeMap<[u32; 2], (f64, u64)> = BTreeMap::new();
    for tet in forced {
        let (angle, count) = pairs.entry(tet.facets).or_insert((tet.angle, 0));
        *angle = angle.min(tet.angle);
        *count += 1;
    }
    let pair = |(between, (angle, tets)): (&[u32; 2], &(f64, u64))| json!({ "between": between, "angle": angle, "tets": tets });
    pairs.iter().map(pair).collect()
}

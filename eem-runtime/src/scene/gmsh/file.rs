//! The sections of a file that hold nodes and elements, which have to agree with what they say of themselves.

use std::collections::BTreeMap;

use super::error::{LineFault, MshError};
use super::kind::Kind;
use super::lines::{Line, Lines, Section};

/// Elements of one type that belong to one entity.
#[derive(Clone, Debug)]
pub(super) struct Block {
    pub(super) dimension: usize,
    /// The tag of the entity.
    pub(super) entity: i32,
    pub(super) kind: Kind,
    /// Tags of elements, each with those of its nodes.
    pub(super) elements: Vec<(u64, Vec<u64>)>,
}

/// Nodes by tag, and blocks of elements.
pub(super) type Content = (BTreeMap<u64, [f64; 3]>, Vec<Block>);

/// Reads the sections that hold the mesh; others are passed over.
pub(super) fn read(text: &str) -> Result<Content, MshError> {
    let mut lines = Lines::of(text);
    let (mut nodes, mut blocks) = (None, None);
    // The lines where the sections begin that there is one of.
    let mut heads = BTreeMap::new();
    while let Some(section) = lines.section()? {
        let is_mesh = ["MeshFormat", "Nodes", "Elements"].contains(&section.name);
        if !is_mesh {
            lines.skip(section)?;
            continue;
        }
        if let Some(first) = heads.insert(section.name, section.line) {
            let (name, line) = (section.name.to_owned(), section.line);
            return Err(MshError::SecondSection { name, first, line });
        }
        match section.name {
            "MeshFormat" => read_format(&mut lines, section)?,
            "Nodes" => nodes = Some(read_nodes(&mut lines, section)?),
            _ => blocks = Some(read_elements(&mut lines, section)?),
        }
    }
    let missing = |name| MshError::Section { name };
    if !heads.contains_key("MeshFormat") {
        return Err(missing("MeshFormat"));
    }
    let nodes = nodes.ok_or(missing("Nodes"))?;
    Ok((nodes, blocks.ok_or(missing("Elements"))?))
}

/// Version 4.1, in ASCII, with numbers of eight bytes.
fn read_format(lines: &mut Lines<'_>, section: Section<'_>) -> Result<(), MshError> {
    let found = lines.line(section)?.text;
    if !found.split_ascii_whitespace().eq(["4.1", "0", "8"]) {
        let found = found.to_owned();
        return Err(MshError::Format { found });
    }
    lines.end(section)
}

fn read_nodes(
    lines: &mut Lines<'_>,
    section: Section<'_>,
) -> Result<BTreeMap<u64, [f64; 3]>, MshError> {
    let totals = Totals::read(lines, section)?;
    let mut tags = Tags::default();
    let mut nodes = BTreeMap::new();
    for _ in 0..totals.blocks {
        let (line, [dimension, _, parametric, count], _) = lines.head(section)?;
        let dimension = entity_dimension(line, section, dimension)?;
        // The coordinates of a node within its entity follow its place.
        let own = match parametric {
            0 => 0,
            1 => dimension,
            found => return Err(line.wrong(section, LineFault::Parametric { found })),
        };
        let mut of_block = Vec::new();
        for _ in 0..count {
            let (line, tag) = lines.numbers::<u64>(section, |count| count == 1)?;
            tags.add(tag[0], line, section)?;
            of_block.push(tag[0]);
        }
        for tag in of_block {
            let (_, place) = lines.numbers::<f64>(section, |count| count == 3 + own)?;
            nodes.insert(tag, [place[0], place[1], place[2]]);
        }
    }
    lines.end(section)?;
    totals.check(&tags, section)?;
    Ok(nodes)
}

fn read_elements(lines: &mut Lines<'_>, section: Section<'_>) -> Result<Vec<Block>, MshError> {
    let totals = Totals::read(lines, section)?;
    let mut tags = Tags::default();
    let mut all = Vec::new();
    for _ in 0..totals.blocks {
        let (line, [dimension, _, kind, count], entity) = lines.head(section)?;
        let dimension = entity_dimension(line, section, dimension)?;
        let kind = u32::try_from(kind).map_err(|_| line.wrong(section, LineFault::Numbers))?;
        let kind = Kind::of(kind);
        if let Some(needed) = kind.dimension.filter(|&needed| needed != dimension) {
            let fault = LineFault::Dimension {
                found: dimension,
                elements: kind.name,
                needed,
            };
            return Err(line.wrong(section, fault));
        }
        let mut elements = Vec::new();
        for _ in 0..count {
            let is_right = |count| count > 1 && kind.nodes.is_none_or(|nodes| count == nodes + 1);
            let (line, numbers) = lines.numbers::<u64>(section, is_right)?;
            tags.add(numbers[0], line, section)?;
            elements.push((numbers[0], numbers[1..].to_vec()));
        }
        all.push(Block {
            dimension,
            entity,
            kind,
            elements,
        });
    }
    lines.end(section)?;
    totals.check(&tags, section)?;
    Ok(all)
}

/// That of the entity of a block.
fn entity_dimension(line: Line<'_>, section: Section<'_>, found: u64) -> Result<usize, MshError> {
    let dimension = usize::try_from(found).ok();
    let dimension = dimension.filter(|&dimension| dimension <= 3);
    dimension.ok_or_else(|| line.wrong(section, LineFault::EntityDimension { found }))
}

/// What the first line of a section says of all of it.
struct Totals<'a> {
    line: Line<'a>,
    blocks: u64,
    count: u64,
    /// The least and the largest tag.
    range: [u64; 2],
}

impl<'a> Totals<'a> {
    fn read(lines: &mut Lines<'a>, section: Section<'_>) -> Result<Self, MshError> {
        let (line, numbers) = lines.numbers::<u64>(section, |count| count == 4)?;
        Ok(Self {
            line,
            blocks: numbers[0],
            count: numbers[1],
            range: [numbers[2], numbers[3]],
        })
    }

    /// An error unless the blocks hold what is said of them.
    fn check(&self, tags: &Tags, section: Section<'_>) -> Result<(), MshError> {
        let mut ends = tags.0.keys();
        let count = ends.len();
        let least = ends.next().copied();
        let range = least.map(|least| [least, ends.next_back().copied().unwrap_or(least)]);
        let agrees = range.is_none_or(|range| range == self.range);
        if u64::try_from(count) == Ok(self.count) && agrees {
            return Ok(());
        }
        let range = range.unwrap_or_default();
        let fault = LineFault::Totals { count, range };
        Err(self.line.wrong(section, fault))
    }
}

/// Tags, with the lines where they are.
#[derive(Default)]
struct Tags(BTreeMap<u64, usize>);

impl Tags {
    /// An error if the tag is there already.
    fn add(&mut self, tag: u64, line: Line<'_>, section: Section<'_>) -> Result<(), MshError> {
        match self.0.insert(tag, line.number) {
            Some(first) => Err(line.wrong(section, LineFault::Repeated { tag, first })),
            None => Ok(()),
        }
    }
}

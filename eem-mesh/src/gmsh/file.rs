//! The sections with nodes and elements, which must agree with their own first lines.

use std::collections::BTreeMap;
use std::str::FromStr;

use super::error::{LineFault, MshError};

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

/// Reads the sections of the mesh and skips others.
pub(super) fn read(text: &str) -> Result<Content, MshError> {
    let mut lines = Lines::of(text);
    let (mut format, mut nodes, mut blocks) = (None, None, None);
    // The lines where these sections begin.
    let mut heads = BTreeMap::new();
    while lines.begin_section()? {
        let Section { name, line } = lines.section;
        if !["MeshFormat", "Nodes", "Elements"].contains(&name) {
            lines.skip()?;
            continue;
        }
        if let Some(first) = heads.insert(name, line) {
            let name = name.to_owned();
            return Err(MshError::SecondSection { name, first, line });
        }
        match name {
            "MeshFormat" => format = Some(read_format(&mut lines)?),
            "Nodes" => nodes = Some(read_nodes(&mut lines)?),
            _ => blocks = Some(read_elements(&mut lines)?),
        }
    }
    let missing = |name| MshError::Section { name };
    format.ok_or(missing("MeshFormat"))?;
    let nodes = nodes.ok_or(missing("Nodes"))?;
    Ok((nodes, blocks.ok_or(missing("Elements"))?))
}

/// Version 4.1 in ASCII, with numbers of eight bytes.
fn read_format(lines: &mut Lines<'_>) -> Result<(), MshError> {
    let found = lines.line()?.text;
    if !found.split_ascii_whitespace().eq(["4.1", "0", "8"]) {
        let found = found.to_owned();
        return Err(MshError::Format { found });
    }
    lines.end()
}

fn read_nodes(lines: &mut Lines<'_>) -> Result<BTreeMap<u64, [f64; 3]>, MshError> {
    let totals = Totals::read(lines)?;
    let mut tags = Tags::default();
    let mut nodes = BTreeMap::new();
    for _ in 0..totals.blocks {
        let (line, [dimension, _, parametric, count], _) = lines.head()?;
        let dimension = entity_dimension(line, dimension)?;
        // The coordinates of a node within its entity follow its position.
        let own = match parametric {
            0 => 0,
            1 => dimension,
            found => return Err(line.wrong(LineFault::Parametric { found })),
        };
        let mut of_block = Vec::new();
        for _ in 0..count {
            let (line, tag) = lines.numbers::<u64>(|count| count == 1)?;
            tags.add(tag[0], line)?;
            of_block.push(tag[0]);
        }
        for tag in of_block {
            let (_, place) = lines.numbers::<f64>(|count| count == 3 + own)?;
            nodes.insert(tag, [place[0], place[1], place[2]]);
        }
    }
    lines.end()?;
    totals.check(&tags)?;
    Ok(nodes)
}

fn read_elements(lines: &mut Lines<'_>) -> Result<Vec<Block>, MshError> {
    let totals = Totals::read(lines)?;
    let mut tags = Tags::default();
    let mut all = Vec::new();
    for _ in 0..totals.blocks {
        let (line, [dimension, _, kind, count], entity) = lines.head()?;
        let dimension = entity_dimension(line, dimension)?;
        let kind = u32::try_from(kind).map_err(|_| line.wrong(LineFault::Numbers))?;
        let kind = Kind::of(kind);
        if let Some(needed) = kind.dimension.filter(|&needed| needed != dimension) {
            return Err(line.wrong(LineFault::Dimension {
                found: dimension,
                elements: kind.name,
                needed,
            }));
        }
        let mut elements = Vec::new();
        for _ in 0..count {
            let is_right = |count| count > 1 && kind.nodes.is_none_or(|nodes| count == nodes + 1);
            let (line, numbers) = lines.numbers::<u64>(is_right)?;
            tags.add(numbers[0], line)?;
            elements.push((numbers[0], numbers[1..].to_vec()));
        }
        all.push(Block {
            dimension,
            entity,
            kind,
            elements,
        });
    }
    lines.end()?;
    totals.check(&tags)?;
    Ok(all)
}

/// The dimension of the entity of a block.
fn entity_dimension(line: Line<'_>, found: u64) -> Result<usize, MshError> {
    let dimension = usize::try_from(found).ok();
    let dimension = dimension.filter(|&dimension| dimension <= 3);
    dimension.ok_or_else(|| line.wrong(LineFault::EntityDimension { found }))
}

/// The first line of a section, which describes all of it.
struct Totals<'a> {
    line: Line<'a>,
    blocks: u64,
    count: u64,
    /// The least and the largest tag.
    range: [u64; 2],
}

impl<'a> Totals<'a> {
    fn read(lines: &mut Lines<'a>) -> Result<Self, MshError> {
        let (line, numbers) = lines.numbers::<u64>(|count| count == 4)?;
        Ok(Self {
            line,
            blocks: numbers[0],
            count: numbers[1],
            range: [numbers[2], numbers[3]],
        })
    }

    /// An error unless the blocks agree with the line.
    fn check(&self, tags: &Tags) -> Result<(), MshError> {
        let (count, ends) = (
            tags.0.len(),
            [tags.0.keys().next(), tags.0.keys().next_back()],
        );
        let range = ends[0].zip(ends[1]).map(|(&least, &most)| [least, most]);
        let agrees = range.is_none_or(|range| range == self.range);
        if u64::try_from(count) == Ok(self.count) && agrees {
            return Ok(());
        }
        let range = range.unwrap_or_default();
        Err(self.line.wrong(LineFault::Totals { count, range }))
    }
}

/// Tags with the numbers of their lines.
#[derive(Default)]
struct Tags(BTreeMap<u64, usize>);

impl Tags {
    /// An error if the tag has been read before.
    fn add(&mut self, tag: u64, line: Line<'_>) -> Result<(), MshError> {
        match self.0.insert(tag, line.number) {
            Some(first) => Err(line.wrong(LineFault::Repeated { tag, first })),
            None => Ok(()),
        }
    }
}

/// A type of elements.
#[derive(Clone, Copy, Debug)]
pub(super) struct Kind {
    pub(super) name: &'static str,
    /// The dimension of their entities, if it is known.
    pub(super) dimension: Option<usize>,
    /// The number of nodes of an element, if it is known.
    pub(super) nodes: Option<usize>,
}

impl Kind {
    /// The type with a number. Types of which no mesh can be made are named by their shape.
    pub(super) const fn of(number: u32) -> Self {
        let (name, dimension, nodes) = match number {
            15 => ("points", 0, Some(1)),
            1 => ("lines", 1, Some(2)),
            8 => ("lines", 1, Some(3)),
            26..=28 => ("lines", 1, None),
            2 => ("triangles", 2, Some(3)),
            9 => ("triangles", 2, Some(6)),
            20..=25 => ("triangles", 2, None),
            3 => ("Quad4", 2, Some(4)),
            16 => ("Quad8", 2, Some(8)),
            10 => ("quadrilaterals of 9 nodes", 2, Some(9)),
            4 => ("tetrahedra", 3, Some(4)),
            11 => ("tetrahedra", 3, Some(10)),
            29..=33 => ("tetrahedra", 3, None),
            5 => ("Hex8", 3, Some(8)),
            17 => ("Hex20", 3, Some(20)),
            12 => ("hexahedra of 27 nodes", 3, Some(27)),
            6 => ("prisms", 3, Some(6)),
            13 => ("prisms", 3, Some(18)),
            18 => ("prisms", 3, Some(15)),
            7 => ("pyramids", 3, Some(5)),
            14 => ("pyramids", 3, Some(14)),
            19 => ("pyramids", 3, Some(13)),
            _ => {
                return Self {
                    name: "elements of another type",
                    dimension: None,
                    nodes: None,
                };
            }
        };
        Self {
            name,
            dimension: Some(dimension),
            nodes,
        }
    }
}

/// The lines of a file, from the next one to be read.
pub(super) struct Lines<'a> {
    all: Vec<&'a str>,
    /// The index of the next line.
    next: usize,
    /// The present section.
    pub(super) section: Section<'a>,
}

/// A section of a file.
#[derive(Clone, Copy, Debug)]
pub(super) struct Section<'a> {
    pub(super) name: &'a str,
    /// The number of the line with its name, from 1.
    pub(super) line: usize,
}

/// A line of a section.
#[derive(Clone, Copy, Debug)]
pub(super) struct Line<'a> {
    section: Section<'a>,
    /// Its number, from 1.
    pub(super) number: usize,
    pub(super) text: &'a str,
}

impl<'a> Lines<'a> {
    /// All lines, without a byte order mark.
    pub(super) fn of(text: &'a str) -> Self {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        Self {
            all: text.lines().map(str::trim).collect(),
            next: 0,
            section: Section { name: "", line: 0 },
        }
    }

    /// The next line that is not empty.
    fn next(&mut self) -> Option<Line<'a>> {
        let index = self.next
            + self.all[self.next..]
                .iter()
                .position(|text| !text.is_empty())?;
        self.next = index + 1;
        Some(Line {
            section: self.section,
            number: self.next,
            text: self.all[index],
        })
    }

    /// Begins the next section; false at the end of the file.
    pub(super) fn begin_section(&mut self) -> Result<bool, MshError> {
        let Some(Line { number, text, .. }) = self.next() else {
            return Ok(false);
        };
        match text.strip_prefix('$') {
            Some(name) => {
                self.section = Section { name, line: number };
                Ok(true)
            }
            None => Err(MshError::Outside {
                line: number,
                found: text.to_owned(),
            }),
        }
    }

    /// The next line of the section.
    pub(super) fn line(&mut self) -> Result<Line<'a>, MshError> {
        let Section { name, line } = self.section;
        self.next().ok_or_else(|| MshError::Unended {
            section: name.to_owned(),
            line,
        })
    }

    /// The next line, of as many numbers as `is_count` allows.
    pub(super) fn numbers<T: FromStr>(
        &mut self,
        is_count: impl Fn(usize) -> bool,
    ) -> Result<(Line<'a>, Vec<T>), MshError> {
        let line = self.line()?;
        let words = line.text.split_ascii_whitespace().map(str::parse);
        let numbers: Result<Vec<T>, T::Err> = words.collect();
        match numbers {
            Ok(numbers) if is_count(numbers.len()) => Ok((line, numbers)),
            _ => Err(line.wrong(LineFault::Numbers)),
        }
    }

    /// The next line, of four integers, of which only the second may be negative.
    pub(super) fn head(&mut self) -> Result<(Line<'a>, [u64; 4], i32), MshError> {
        let (line, numbers) = self.numbers::<i128>(|count| count == 4)?;
        let wrong = || line.wrong(LineFault::Numbers);
        let mut all = [0; 4];
        for (at, (to, &from)) in all.iter_mut().zip(&numbers).enumerate() {
            if at != 1 {
                *to = u64::try_from(from).map_err(|_| wrong())?;
            }
        }
        let entity = i32::try_from(numbers[1]).map_err(|_| wrong())?;
        Ok((line, all, entity))
    }

    /// Reads the end of the section.
    pub(super) fn end(&mut self) -> Result<(), MshError> {
        let line = self.line()?;
        if line.is_end() {
            return Ok(());
        }
        Err(line.wrong(LineFault::NotTheEnd))
    }

    /// Skips the rest of the section.
    pub(super) fn skip(&mut self) -> Result<(), MshError> {
        while !self.line()?.is_end() {}
        Ok(())
    }
}

impl Line<'_> {
    fn is_end(self) -> bool {
        self.text.strip_prefix("$End") == Some(self.section.name)
    }

    /// The error of the line.
    pub(super) fn wrong(self, fault: LineFault) -> MshError {
        MshError::Line {
            section: self.section.name.to_owned(),
            line: self.number,
            found: self.text.to_owned(),
            fault,
        }
    }
}

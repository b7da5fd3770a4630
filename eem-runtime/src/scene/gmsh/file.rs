//! The sections of a file that hold nodes and elements, line by line.

use std::collections::BTreeMap;
use std::str::FromStr;

use super::error::MshError;

/// Elements of one type that belong to one entity.
#[derive(Clone, Debug)]
pub(super) struct Block {
    pub(super) dimension: usize,
    /// The tag of the entity.
    pub(super) entity: i32,
    /// The number of the type of its elements.
    kind: u32,
    /// Tags of elements, each with those of its nodes.
    pub(super) elements: Vec<(u64, Vec<u64>)>,
}

impl Block {
    /// The type of its elements.
    pub(super) fn name(&self) -> &'static str {
        match self.kind {
            1 | 8 | 26..=28 => "lines",
            2 | 9 | 20..=25 => "triangles",
            3 => "Quad4",
            16 => "Quad8",
            10 => "quadrilaterals of 9 nodes",
            4 | 11 | 29..=33 => "tetrahedra",
            5 => "Hex8",
            17 => "Hex20",
            12 => "hexahedra of 27 nodes",
            6 | 13 | 18 => "prisms",
            7 | 14 | 19 => "pyramids",
            15 => "points",
            _ => "elements of another type",
        }
    }

    /// How many nodes an element has, where it matters.
    fn nodes(&self) -> Option<usize> {
        match self.kind {
            3 => Some(4),
            5 | 16 => Some(8),
            17 => Some(20),
            _ => None,
        }
    }
}

/// Nodes by tag, and blocks of elements.
pub(super) type Content = (BTreeMap<u64, [f64; 3]>, Vec<Block>);

/// Reads the sections that hold the mesh; others are passed over.
pub(super) fn read(text: &str) -> Result<Content, MshError> {
    let format = Section::of(text, "MeshFormat").and_then(|mut section| section.line());
    let format = format.map_or_else(|_| String::new(), |(_, line)| line.trim().to_owned());
    let words: Vec<_> = format.split_ascii_whitespace().collect();
    if words.get(..2) != Some(&["4.1", "0"]) {
        return Err(MshError::Format { found: format });
    }
    let nodes = read_nodes(Section::of(text, "Nodes")?)?;
    let blocks = read_elements(Section::of(text, "Elements")?)?;
    Ok((nodes, blocks))
}

fn read_nodes(mut section: Section<'_>) -> Result<BTreeMap<u64, [f64; 3]>, MshError> {
    let [blocks, ..] = section.numbers::<usize, 4>()?;
    let mut nodes = BTreeMap::new();
    for _ in 0..blocks {
        let [.., count] = section.numbers::<i64, 4>()?;
        let mut tags = Vec::new();
        for _ in 0..count {
            let [tag] = section.numbers::<u64, 1>()?;
            tags.push(tag);
        }
        for node in tags {
            // Parametric coordinates may follow.
            let place = section.numbers_and_more::<f64, 3>()?;
            if nodes.insert(node, place).is_some() {
                return Err(MshError::RepeatedNode { node });
            }
        }
    }
    Ok(nodes)
}

fn read_elements(mut section: Section<'_>) -> Result<Vec<Block>, MshError> {
    let [blocks, ..] = section.numbers::<usize, 4>()?;
    let mut all = Vec::new();
    for _ in 0..blocks {
        let (line, [dimension, entity, kind, count]) = (section.at, section.numbers::<i64, 4>()?);
        let (Ok(dimension), Ok(entity), Ok(kind)) = (
            usize::try_from(dimension),
            i32::try_from(entity),
            u32::try_from(kind),
        ) else {
            return Err(section.wrong(line));
        };
        let mut block = Block {
            dimension,
            entity,
            kind,
            elements: Vec::new(),
        };
        for _ in 0..count {
            let (line, words) = section.line()?;
            let words: Result<Vec<u64>, _> =
                words.split_ascii_whitespace().map(str::parse).collect();
            let words = words.unwrap_or_default();
            match words.split_first() {
                Some((&tag, nodes)) if block.nodes().is_none_or(|count| count == nodes.len()) => {
                    block.elements.push((tag, nodes.to_vec()));
                }
                _ => return Err(section.wrong(line)),
            }
        }
        all.push(block);
    }
    Ok(all)
}

/// The lines of a section that have not been read.
struct Section<'a> {
    name: &'static str,
    lines: Vec<&'a str>,
    /// The next line, from 0.
    at: usize,
}

impl<'a> Section<'a> {
    /// The section with a name.
    fn of(text: &'a str, name: &'static str) -> Result<Self, MshError> {
        let lines: Vec<_> = text.lines().collect();
        let is_head = |line: &&str| line.trim().strip_prefix('$') == Some(name);
        let head = lines.iter().position(is_head);
        let head = head.ok_or(MshError::Section { name })?;
        let at = head + 1;
        Ok(Self { name, lines, at })
    }

    /// The next line that is not empty, with its number, from 0.
    fn line(&mut self) -> Result<(usize, &'a str), MshError> {
        loop {
            let at = self.at;
            match self.lines.get(at).map(|line| line.trim()) {
                Some("") => self.at += 1,
                Some(line) if !line.starts_with('$') => {
                    self.at += 1;
                    return Ok((at, line));
                }
                _ => return Err(self.wrong(at)),
            }
        }
    }

    /// The next line, of so many numbers.
    fn numbers<T: FromStr, const N: usize>(&mut self) -> Result<[T; N], MshError> {
        let at = self.at;
        let numbers: Vec<T> = self.all_numbers()?;
        numbers.try_into().map_err(|_| self.wrong(at))
    }

    /// The next line, of so many numbers at least.
    fn numbers_and_more<T: FromStr, const N: usize>(&mut self) -> Result<[T; N], MshError> {
        let at = self.at;
        let mut numbers: Vec<T> = self.all_numbers()?;
        numbers.truncate(N);
        numbers.try_into().map_err(|_| self.wrong(at))
    }

    fn all_numbers<T: FromStr>(&mut self) -> Result<Vec<T>, MshError> {
        let (at, line) = self.line()?;
        let words = line.split_ascii_whitespace().map(str::parse);
        let numbers: Result<_, T::Err> = words.collect();
        numbers.map_err(|_| self.wrong(at))
    }

    /// What is in a line, from 0, is not what has to be there.
    fn wrong(&self, line: usize) -> MshError {
        MshError::Line {
            section: self.name,
            line: line + 1,
            found: self
                .lines
                .get(line)
                .map_or("", |line| line.trim())
                .to_owned(),
        }
    }
}

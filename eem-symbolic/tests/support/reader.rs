//! Formulas in tests as text: `+ - * / ^`, parentheses, names, decimal numbers, functions, `sqrt`.

use eem_symbolic::{ExprId, Function, Graph, Number};

/// Reads a formula into the graph; names become symbols.
pub(crate) fn read(graph: &mut Graph, text: &str) -> ExprId {
    let mut reader = Reader { graph, rest: text };
    let e = reader.sum();
    assert!(
        reader.rest.trim().is_empty(),
        "`{}` is left of `{text}`",
        reader.rest
    );
    e
}

struct Reader<'a> {
    graph: &'a mut Graph,
    rest: &'a str,
}

impl<'a> Reader<'a> {
    fn accept(&mut self, token: char) -> bool {
        self.rest = self.rest.trim_start();
        let found = self.rest.starts_with(token);
        if found {
            self.rest = &self.rest[token.len_utf8()..];
        }
        found
    }

    fn sum(&mut self) -> ExprId {
        let mut sum = self.product();
        loop {
            if self.accept('+') {
                let term = self.product();
                sum = self.graph.add(sum, term);
            } else if self.accept('-') {
                let term = self.product();
                sum = self.graph.sub(sum, term);
            } else {
                return sum;
            }
        }
    }

    fn product(&mut self) -> ExprId {
        let mut product = self.signed();
        loop {
            if self.accept('*') {
                let factor = self.signed();
                product = self.graph.mul(product, factor);
            } else if self.accept('/') {
                let factor = self.signed();
                product = self.graph.div(product, factor);
            } else {
                return product;
            }
        }
    }

    fn signed(&mut self) -> ExprId {
        if self.accept('-') {
            let operand = self.signed();
            return self.graph.neg(operand);
        }
        let base = self.atom();
        if !self.accept('^') {
            return base;
        }
        let exponent = if self.accept('-') {
            let exponent = self.atom();
            self.graph.neg(exponent)
        } else {
            self.atom()
        };
        self.graph.power(base, exponent)
    }

    fn atom(&mut self) -> ExprId {
        if self.accept('(') {
            let e = self.sum();
            assert!(self.accept(')'), "`)` expected before `{}`", self.rest);
            return e;
        }
        let word = self.word();
        if word.starts_with(|c: char| c.is_ascii_digit()) {
            let number = Number::parse_decimal(word).expect("a decimal number");
            return self.graph.number(number);
        }
        if self.accept('(') {
            let argument = self.sum();
            assert!(self.accept(')'), "`)` expected before `{}`", self.rest);
            return match Function::from_name(word) {
                Some(function) => self.graph.apply(function, argument),
                None if word == "sqrt" => self.graph.sqrt(argument),
                None => panic!("unknown function `{word}`"),
            };
        }
        let symbol = self.graph.symbol(word);
        self.graph.variable(symbol)
    }

    fn word(&mut self) -> &'a str {
        self.rest = self.rest.trim_start();
        let number = self.rest.starts_with(|c: char| c.is_ascii_digit());
        let mut previous = ' ';
        let mut belongs = |c: char| {
            let exponent = number && c == '-' && previous == 'e';
            previous = c;
            c.is_alphanumeric() || c == '.' || c == '_' || exponent
        };
        let letters = self.rest.chars().take_while(|&c| belongs(c));
        let length: usize = letters.map(char::len_utf8).sum();
        assert!(
            length > 0,
            "a name or a number expected before `{}`",
            self.rest
        );
        let (word, rest) = self.rest.split_at(length);
        self.rest = rest;
        word
    }
}

#include "pqPointFrontTable.h"

#include <vtkPVXMLElement.h>
#include <vtkSMProperty.h>

#include <QAbstractItemView>
#include <QHeaderView>
#include <QSignalBlocker>
#include <QTableWidget>
#include <QVBoxLayout>

#include <algorithm>

namespace
{

constexpr int mostRowsSeen = 6; ///< more of them scroll
constexpr int narrowestColumn = 24; ///< pixels

QStringList headsOf(vtkSMProperty* property)
{
  QStringList heads;
  vtkPVXMLElement* const hints = property->GetHints();
  vtkPVXMLElement* const table =
    hints ? hints->FindNestedElementByName("PointFrontTable") : nullptr;
  for (unsigned int i = 0; table && i < table->GetNumberOfNestedElements(); ++i)
  {
    heads << QString::fromUtf8(table->GetNestedElement(i)->GetAttributeOrEmpty("label"));
  }
  return heads;
}

} // namespace

pqPointFrontTable::pqPointFrontTable(
  vtkSMProxy* proxy, vtkSMProperty* property, QWidget* parentWidget)
  : pqPropertyWidget(proxy, parentWidget)
  , Table(new QTableWidget(this))
{
  const QStringList heads = headsOf(property);
  this->setShowLabel(false); // that of its group stands above it
  this->Table->setObjectName("Table");
  this->Table->setColumnCount(heads.size());
  this->Table->setHorizontalHeaderLabels(heads);
  this->Table->setToolTip(pqPropertyWidget::getTooltip(property));
  this->Table->verticalHeader()->hide();
  this->Table->setEditTriggers(QAbstractItemView::AllEditTriggers);
  this->Table->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  this->Table->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
  QHeaderView* const columns = this->Table->horizontalHeader();
  columns->setMinimumSectionSize(narrowestColumn);
  columns->setSectionResizeMode(QHeaderView::Stretch);
  auto* const layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(this->Table);
  this->fill({});
  QObject::connect(this->Table, &QTableWidget::cellChanged, this, &pqPointFrontTable::takeEdit);
  this->addPropertyLink(this, "values", SIGNAL(valuesChanged()), property);
}

pqPointFrontTable::~pqPointFrontTable() = default;

bool pqPointFrontTable::isEmpty(int row) const
{
  for (int column = 0; column < this->Table->columnCount(); ++column)
  {
    const QTableWidgetItem* const cell = this->Table->item(row, column);
    if (cell && !cell->text().trimmed().isEmpty())
    {
      return false;
    }
  }
  return true;
}

QVariantList pqPointFrontTable::values() const
{
  QVariantList values;
  for (int row = 0; row < this->Table->rowCount(); ++row)
  {
    for (int column = 0; !this->isEmpty(row) && column < this->Table->columnCount(); ++column)
    {
      const QTableWidgetItem* const cell = this->Table->item(row, column);
      values << (cell ? cell->text().trimmed() : QString());
    }
  }
  return values;
}

void pqPointFrontTable::setValues(const QVariantList& values)
{
  if (values == this->values())
  {
    return; // whoever is typing goes on
  }
  this->fill(values);
  Q_EMIT this->valuesChanged();
}

void pqPointFrontTable::takeEdit()
{
  const int last = this->Table->rowCount() - 1;
  if (!this->isEmpty(last))
  {
    this->fill(this->values());
  }
  Q_EMIT this->valuesChanged();
}

void pqPointFrontTable::fill(const QVariantList& values)
{
  const QSignalBlocker blocker(this->Table);
  const int columns = this->Table->columnCount();
  const int rows = columns > 0 ? values.size() / columns + 1 : 0;
  this->Table->setRowCount(rows);
  for (int row = 0; row < rows; ++row)
  {
    for (int column = 0; column < columns; ++column)
    {
      const int place = row * columns + column;
      const QString text = place < values.size() ? values[place].toString() : QString();
      this->Table->setItem(row, column, new QTableWidgetItem(text));
    }
  }
  const int seen = std::clamp(rows, 1, mostRowsSeen);
  this->Table->setFixedHeight(this->Table->horizontalHeader()->sizeHint().height() +
    seen * this->Table->verticalHeader()->defaultSectionSize() + 2 * this->Table->frameWidth());
}
